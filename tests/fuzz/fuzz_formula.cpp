#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "formula/formula.h"
#include "formula/formula_units.h"
#include "formula/formula_values.h"
#include "fuzz/fuzz.h"

namespace {

using namespace splotchcl;

constexpr std::size_t particles = 3;

// Some units are known, and some fields hold whole numbers.
std::optional<WrittenUnit> unit_of_field(const std::string& name) {
  if (name.size() == 1) return std::nullopt;
  return written_unit(name.size() % 2 == 0 ? "K" : "g/cm^3", {});
}

FormulaSources sources() {
  FormulaSources sources;
  sources.values = [](const std::string&) -> FieldValues {
    return [](std::size_t begin, std::size_t end, double* out) {
      for (std::size_t i = begin; i < end; ++i)
        *out++ = 1.5 * static_cast<double>(i) - 1;
    };
  };
  sources.whole_numbers = [](const std::string& name, bool) -> std::optional<WholeNumbers> {
    if (name != "id") return std::nullopt;
    const std::vector<std::uint64_t> ids = {1, 9007199254740993, 18446744073709551615U};
    return WholeNumbers{std::make_shared<const std::vector<std::uint64_t>>(ids), false};
  };
  return sources;
}

}  // namespace

void splotchcl::fuzz::fuzz_formula(const std::uint8_t* data, std::size_t size) {
  try {
    const Formula formula = with_converted_numbers(
        Formula::parse(std::string(reinterpret_cast<const char*>(data), size), "fuzz"),
        unit_of_field, {0.5, 0.7}, "fuzz");
    const FormulaValues values(formula, sources());
    double out[particles];
    values.evaluate(0, particles, out);
    for (const double value : out) {
      if (formula.is_condition() && value != 0 && value != 1) __builtin_trap();
    }
    unit_of_formula(formula, unit_of_field, "fuzz");
  } catch (const splotchcl::Error&) {
    // refused
  }
}
