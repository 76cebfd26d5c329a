#include "formula/formula_functions.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

template <double (*function)(double)>
constexpr FormulaFunction of_one(const char* name, FunctionUnit unit = FunctionUnit::none) {
  return {name, function, nullptr, unit};
}

constexpr FormulaFunction of_two(const char* name, double (*function)(double, double),
                                 FunctionUnit unit) {
  return {name, nullptr, function, unit};
}

// What is not a number stays none, which fmin and fmax would hide.
double lesser(double a, double b) {
  return std::isnan(a) || a < b ? a : b;
}

double greater(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

}  // namespace

const std::vector<FormulaFunction>& formula_functions() {
  using Unit = FunctionUnit;
  static const std::vector<FormulaFunction> functions = {
      of_one<std::sqrt>("sqrt", Unit::square_root),
      of_one<std::cbrt>("cbrt", Unit::cube_root),
      of_one<std::fabs>("abs", Unit::same),
      of_one<std::floor>("floor", Unit::same),
      of_one<std::ceil>("ceil", Unit::same),
      of_one<std::round>("round", Unit::same),
      of_one<std::exp>("exp"),
      of_one<std::log>("log"),
      of_one<std::log>("ln"),
      of_one<std::log10>("log10"),
      of_one<std::log2>("log2"),
      of_one<std::sin>("sin"),
      of_one<std::cos>("cos"),
      of_one<std::tan>("tan"),
      of_one<std::asin>("asin"),
      of_one<std::acos>("acos"),
      of_one<std::atan>("atan"),
      of_one<std::sinh>("sinh"),
      of_one<std::cosh>("cosh"),
      of_one<std::tanh>("tanh"),
      of_one<std::asinh>("asinh"),
      of_one<std::acosh>("acosh"),
      of_one<std::atanh>("atanh"),
      of_two("atan2", std::atan2, Unit::none),
      of_two("hypot", std::hypot, Unit::same),
      of_two("min", lesser, Unit::same),
      of_two("max", greater, Unit::same),
  };
  return functions;
}

std::optional<std::size_t> find_formula_function(const std::string& name) {
  const auto& all = formula_functions();
  const auto found = std::find_if(all.begin(), all.end(), [&name](const FormulaFunction& function) {
    return name == function.name;
  });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

std::vector<std::string> names_of_formula_functions() {
  std::vector<std::string> names;
  for (const FormulaFunction& function : formula_functions())
    names.emplace_back(function.name);
  return names;
}

}  // namespace splotchcl
