#include "formula/formula_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formula/formula_words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double rounding = 1e-6;

// What is known of the unit of a part's values.
struct PartUnit {
  enum class Kind { unknown, number, known };
  Kind kind = Kind::unknown;
  WrittenUnit unit;  // of a known one; of a number none
};

PartUnit number_unit() {
  return {PartUnit::Kind::number, {}};
}

bool is_plain(const WrittenUnit& unit) {
  return unit.factors.empty();
}

PartUnit of(WrittenUnit unit) {
  const bool is_number = is_plain(unit);
  return {is_number ? PartUnit::Kind::number : PartUnit::Kind::known, std::move(unit)};
}

WrittenUnit raised(const WrittenUnit& unit, double exponent) {
  if (exponent == 0) return {};
  WrittenUnit result = {power(unit.unit, exponent), unit.factors};
  for (auto& [name, p] : result.factors)
    p *= exponent;
  return result;
}

WrittenUnit multiplied(const WrittenUnit& a, const WrittenUnit& b) {
  WrittenUnit result = {a.unit * b.unit, a.factors};
  for (const auto& [name, p] : b.factors) {
    const auto same = std::find_if(result.factors.begin(), result.factors.end(),
                                   [&n = name](const auto& factor) { return factor.first == n; });
    if (same == result.factors.end()) {
      result.factors.emplace_back(name, p);
    } else {
      same->second += p;
    }
  }
  result.factors.erase(
      std::remove_if(result.factors.begin(), result.factors.end(),
                     [](const auto& factor) { return std::abs(factor.second) < rounding; }),
      result.factors.end());
  return result;
}

class UnitFinder {
 public:
  UnitFinder(const Formula& formula, const UnitOfField& unit_of, const std::string& what)
      : formula_(formula), unit_of_(unit_of), what_(what) {}

  PartUnit find() { return find_all().back(); }
  const std::vector<PartUnit>& find_all() {
    for (const FormulaPart& part : formula_.parts())
      units_.push_back(unit_of_part(part));
    return units_;
  }

 private:
  const PartUnit& operand(const FormulaPart& part, std::size_t i) const {
    return units_[part.operands[i]];
  }

  PartUnit unit_of_part(const FormulaPart& part) const {
    switch (part.operation) {
      case Operation::number:
        return number_unit();
      case Operation::field: {
        const auto unit = unit_of_(formula_.fields()[part.name]);
        return unit ? of(*unit) : PartUnit();
      }
      case Operation::negate:
        return operand(part, 0);
      case Operation::multiply:
        return product(part, 1);
      case Operation::divide:
        return product(part, -1);
      case Operation::power:
        return power_of(part);
      case Operation::function:
        return of_function(part);
      case Operation::choose:
        return shared(part, 1);
      case Operation::negation:
      case Operation::both:
      case Operation::either:
        return number_unit();
      default:
        break;
    }
    const PartUnit both = shared(part, 0);
    return is_comparison(part.operation) ? number_unit() : both;
  }

  PartUnit product(const FormulaPart& part, double exponent) const {
    const PartUnit &a = operand(part, 0), &b = operand(part, 1);
    const bool is_unknown = a.kind == PartUnit::Kind::unknown || b.kind == PartUnit::Kind::unknown;
    return is_unknown ? PartUnit() : of(multiplied(a.unit, raised(b.unit, exponent)));
  }

  PartUnit power_of(const FormulaPart& part) const {
    const PartUnit& base = operand(part, 0);
    const std::optional<double> exponent = number_at(part.operands[1]);
    if (base.kind != PartUnit::Kind::known) return base;
    return exponent ? of(raised(base.unit, *exponent)) : PartUnit();
  }

  // Of exponents as they are written: 2, -1, (1/3).
  std::optional<double> number_at(std::size_t index) const {
    const FormulaPart& part = formula_.parts()[index];
    if (part.operation == Operation::number) return part.number;
    if (part.operation == Operation::negate) {
      const auto inner = number_at(part.operands[0]);
      return inner ? std::optional(-*inner) : std::nullopt;
    }
    if (part.operation != Operation::divide) return std::nullopt;
    const auto a = number_at(part.operands[0]), b = number_at(part.operands[1]);
    return a && b && *b != 0 ? std::optional(*a / *b) : std::nullopt;
  }

  PartUnit of_function(const FormulaPart& part) const {
    const PartUnit& first = operand(part, 0);
    switch (formula_functions()[part.name].unit) {
      case FunctionUnit::none:
        return {};
      case FunctionUnit::same:
        return part.operands.size() == 1 ? first : shared(part, 0);
      case FunctionUnit::square_root:
        return first.kind == PartUnit::Kind::known ? of(raised(first.unit, 1.0 / 2)) : first;
      case FunctionUnit::cube_root:
        return first.kind == PartUnit::Kind::known ? of(raised(first.unit, 1.0 / 3)) : first;
    }
    return {};
  }

  // Of two operands that have to have one. A number alone is in the other's.
  PartUnit shared(const FormulaPart& part, std::size_t first) const {
    const PartUnit &a = operand(part, first), &b = operand(part, first + 1);
    if (a.kind != PartUnit::Kind::known || b.kind != PartUnit::Kind::known) {
      if (a.kind == PartUnit::Kind::number) return b;
      return b.kind == PartUnit::Kind::number ? a : PartUnit();
    }
    const bool are_same = same_dimension(a.unit.unit, b.unit.unit) &&
                          std::abs(a.unit.unit.in_cgs / b.unit.unit.in_cgs - 1) < rounding;
    if (!are_same) refuse(part, first);
    return a;
  }

  [[noreturn]] void refuse(const FormulaPart& part, std::size_t first) const {
    const auto& parts = formula_.parts();
    const FormulaPart &left = parts[part.operands[first]], &right = parts[part.operands[first + 1]];
    const std::string &one = operand(part, first).unit.text(),
                      &other = operand(part, first + 1).unit.text();
    throw UsageError(fmt::format(
        "{}: found {} in {} beside {} in {} in \"{}\", expected both in one unit; multiply or "
        "divide to get there",
        what_, formula_.text_of(left), one, formula_.text_of(right), other, formula_.text()));
  }

  const Formula& formula_;
  const UnitOfField& unit_of_;
  const std::string& what_;
  std::vector<PartUnit> units_;
};

bool is_one_name(const std::string& unit) {
  return unit.find_first_of(" /*^()0123456789") == std::string::npos;
}

}  // namespace

std::string WrittenUnit::text() const {
  std::string text;
  for (const auto& [name, exponent] : factors) {
    const bool is_alone = factors.size() == 1 && exponent == 1;
    text += text.empty() ? "" : " ";
    text += is_alone || is_one_name(name) ? name : "(" + name + ")";
    if (std::abs(exponent - 1) > rounding) text += fmt::format("^{:.6g}", exponent);
  }
  return text;
}

std::optional<WrittenUnit> unit_of_formula(const Formula& formula, const UnitOfField& unit_of,
                                           const std::string& what) {
  const PartUnit found = UnitFinder(formula, unit_of, what).find();
  if (found.kind != PartUnit::Kind::known) return std::nullopt;
  return found.unit;
}

namespace {

// What a temperature in kelvin has to be multiplied by to be an energy in erg.
constexpr double erg_per_kelvin = 1.380649e-16;
const Unit kelvin = {1, {0, 0, 0, 1}};
const Unit erg = {1, {2, 1, -2, 0}};

// What numbers in one unit have to be multiplied by to be in another.
std::optional<double> ratio_in_comparison(const Unit& from, const Unit& to) {
  if (same_dimension(from, to)) return from.in_cgs / to.in_cgs;
  const double ratio = from.in_cgs / to.in_cgs;
  if (same_dimension(from, erg) && same_dimension(to, kelvin)) return ratio / erg_per_kelvin;
  if (same_dimension(from, kelvin) && same_dimension(to, erg)) return ratio * erg_per_kelvin;
  return std::nullopt;
}

double converted(const Formula& formula, const FormulaPart& number, const FormulaPart& other,
                 const PartUnit& wanted, const UnitFactors& factors, const std::string& what) {
  const std::string found =
      fmt::format("{}: found {} beside {} in \"{}\"", what, formula.text_of(number),
                  formula.text_of(other), formula.text());
  if (wanted.kind != PartUnit::Kind::known) {
    throw UsageError(found +
                     ", whose unit is not known, expected a number alone; or name the units of "
                     "its fields as read.units");
  }
  // The factors a and h that it has must be known.
  for (const auto& [name, exponent] : wanted.unit.factors)
    parse_unit(name, factors, what);
  const Unit unit = parse_unit(number.unit, factors, what);
  const std::optional<double> ratio = ratio_in_comparison(unit, wanted.unit.unit);
  if (ratio) return number.number * *ratio;
  throw UsageError(fmt::format("{}, which is in {}, expected a unit of the same kind", found,
                               wanted.unit.text()));
}

bool has_unit(const FormulaPart& part) {
  return !part.unit.empty();
}

}  // namespace

Formula with_converted_numbers(Formula formula, const UnitOfField& unit_of,
                               const UnitFactors& factors, const std::string& what) {
  const std::vector<FormulaPart> parts = formula.parts();
  if (std::none_of(parts.begin(), parts.end(), has_unit)) return formula;
  const std::vector<PartUnit> units = UnitFinder(formula, unit_of, what).find_all();
  for (const FormulaPart& part : parts) {
    if (!is_comparison(part.operation)) continue;
    for (const std::size_t side : {0, 1}) {
      const std::size_t number = part.operands[side], other = part.operands[1 - side];
      if (!has_unit(parts[number])) continue;
      formula.replace_number(
          number, converted(formula, parts[number], parts[other], units[other], factors, what));
    }
  }
  return formula;
}

std::optional<WrittenUnit> written_unit(const std::string& text, UnitFactors factors) {
  if (text.empty()) return std::nullopt;
  // Of a and h that are not known dimensions do not depend.
  if (!(factors.scale_factor > 0)) factors.scale_factor = 1;
  if (!(factors.hubble > 0)) factors.hubble = 1;
  try {
    return WrittenUnit{parse_unit(text, factors, "unit"), {{text, 1}}};
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

}  // namespace splotchcl
