#include "snapshot/unit.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/words.h"
#include "scene/constants.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct NamedUnit {
  const char* name;
  Unit unit;
};

constexpr std::array<double, 4> length = {1, 0, 0, 0}, mass = {0, 1, 0, 0}, duration = {0, 0, 1, 0},
                                temperature = {0, 0, 0, 1}, energy = {2, 1, -2, 0},
                                power_of_light = {2, 1, -3, 0}, frequency = {0, 0, -1, 0},
                                flux_density = {0, 1, -2, 0}, magnetic_field = {-0.5, 0.5, -1, 0},
                                number = {};

constexpr double degree = 3.14159265358979323846 / 180, light_year_in_cm = 9.4607304725808e17,
                 sun_in_erg_per_s = 3.828e33;

// L_sun: IAU 2015 B3. ly: the light's way in a Julian year. G is Gaussian: a gauss is the root of
// an erg in a cubic centimeter. pc and au: IAU 2012 B2 and 2015 B2. M_sun: GM_sun of IAU 2015 B3
// over G of CODATA 2018. R_sun: IAU 2015 B3. m_p, k_B, eV: CODATA 2018. yr: the Julian year.
const std::vector<NamedUnit>& known_units() {
  static const std::vector<NamedUnit> units = {
      {"cm", {1, length}},
      {"m", {1e2, length}},
      {"km", {1e5, length}},
      {"au", {1.495978707e13, length}},
      {"AU", {1.495978707e13, length}},
      {"pc", {1e-3 * kpc_in_cm, length}},
      {"kpc", {kpc_in_cm, length}},
      {"Mpc", {1e3 * kpc_in_cm, length}},
      {"Gpc", {1e6 * kpc_in_cm, length}},
      {"R_sun", {6.957e10, length}},
      {"Rsun", {6.957e10, length}},
      {"solRad", {6.957e10, length}},
      {"g", {1, mass}},
      {"kg", {1e3, mass}},
      {"Msun", {1.988409870698051e33, mass}},
      {"M_sun", {1.988409870698051e33, mass}},
      {"solMass", {1.988409870698051e33, mass}},
      {"m_p", {proton_mass_in_g, mass}},
      {"s", {1, duration}},
      {"yr", {3.15576e7, duration}},
      {"Myr", {3.15576e13, duration}},
      {"Gyr", {3.15576e16, duration}},
      {"K", {1, temperature}},
      {"erg", {1, energy}},
      {"J", {1e7, energy}},
      {"eV", {1.602176634e-12, energy}},
      {"keV", {1.602176634e-9, energy}},
      {"MeV", {1.602176634e-6, energy}},
      {"GeV", {1.602176634e-3, energy}},
      {"ly", {light_year_in_cm, length}},
      {"lyr", {light_year_in_cm, length}},
      {"kyr", {3.15576e10, duration}},
      {"W", {1e7, power_of_light}},
      {"Lsun", {sun_in_erg_per_s, power_of_light}},
      {"L_sun", {sun_in_erg_per_s, power_of_light}},
      {"solLum", {sun_in_erg_per_s, power_of_light}},
      {"G", {1, magnetic_field}},
      {"uG", {1e-6, magnetic_field}},
      {"Hz", {1, frequency}},
      {"MHz", {1e6, frequency}},
      {"GHz", {1e9, frequency}},
      {"Jy", {1e-23, flux_density}},
      {"mJy", {1e-26, flux_density}},
      {"rad", {1, number}},
      {"deg", {degree, number}},
      {"arcmin", {degree / 60, number}},
      {"arcsec", {degree / 3600, number}},
      {"sr", {1, number}},
  };
  return units;
}

// Reads the text from left to right.
class Parser {
 public:
  Parser(const std::string& text, const UnitFactors& factors, std::string what)
      : text_(text), factors_(factors), what_(std::move(what)) {}

  Unit parse() {
    const Unit unit = product();
    if (next_ != text_.size()) refuse(fmt::format("'{}'", text_.substr(next_)));
    return unit;
  }

 private:
  void skip_blanks() {
    while (next_ < text_.size() && (text_[next_] == ' ' || text_[next_] == '*'))
      ++next_;
  }
  char peek() {
    skip_blanks();
    return next_ < text_.size() ? text_[next_] : '\0';
  }

  Unit product() {
    Unit unit = factor();
    for (char c = peek(); c != '\0' && c != ')'; c = peek()) {
      const bool divides = c == '/';
      if (divides) ++next_;
      const Unit next = factor();
      unit = unit * (divides ? power(next, -1) : next);
    }
    return unit;
  }

  Unit factor() {
    const Unit unit = base();
    for (const std::string_view mark : {"^", "**"}) {
      if (text_.compare(next_, mark.size(), mark) != 0) continue;
      next_ += mark.size();
      return power(unit, number());
    }
    return unit;
  }

  Unit base() {
    const char c = peek();
    if (c == '(') {
      ++next_;
      const Unit unit = product();
      if (peek() != ')') refuse("no closing parenthesis");
      ++next_;
      return unit;
    }
    if ((c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+') return {number(), {}};
    return named();
  }

  // As in "4Mpc" the unit may follow at once.
  double number() {
    const std::string rest = text_.substr(next_, end_of_number(text_, next_) - next_);
    const std::optional<double> value = parse_number(rest);
    if (!value || !std::isfinite(*value)) refuse(fmt::format("'{}' for a number", rest));
    next_ += rest.size();
    return *value;
  }

  Unit named() {
    const std::size_t end = std::min(text_.find_first_of(" */()^", next_), text_.size());
    const std::string name = text_.substr(next_, end - next_);
    if (name.empty()) refuse("no unit where one should be");
    next_ = end;
    // The second names are those of our FITS files, as solMass and solRad.
    if (name == "a" || name == "scale_factor") return cosmological(name, factors_.scale_factor);
    if (name == "h" || name == "little_h") return cosmological(name, factors_.hubble);
    std::vector<std::string> names;
    for (const NamedUnit& known : known_units()) {
      if (name == known.name) return known.unit;
      names.emplace_back(known.name);
    }
    throw UsageError(fmt::format("{}: found '{}' in \"{}\", expected units among {}, a, h{}", what_,
                                 name, text_, fmt::join(names, ", "),
                                 did_you_mean(nearest_name(name, names))));
  }

  Unit cosmological(const std::string& name, double value) const {
    if (value > 0) return {value, {}};
    throw UsageError(fmt::format(
        "{}: found {} in \"{}\", but the snapshot does not say its value, expected a unit without",
        what_, name, text_));
  }

  [[noreturn]] void refuse(const std::string& found) const {
    throw UsageError(fmt::format(
        "{}: found {} in \"{}\", expected numbers and units with their powers, such as Msun/pc^2",
        what_, found, text_));
  }

  const std::string& text_;
  const UnitFactors& factors_;
  std::string what_;
  std::size_t next_ = 0;
};

}  // namespace

std::size_t end_of_number(const std::string& text, std::size_t first) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  std::size_t i = first;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  while (is_digit(i) || (i < text.size() && text[i] == '.'))
    ++i;
  if (i == first || i >= text.size() || (text[i] != 'e' && text[i] != 'E')) return i;
  const std::size_t sign =
      i + 1 < text.size() && (text[i + 1] == '-' || text[i + 1] == '+') ? 1 : 0;
  if (!is_digit(i + 1 + sign)) return i;  // "4 erg"
  i += 1 + sign;
  while (is_digit(i))
    ++i;
  return i;
}

Unit operator*(const Unit& a, const Unit& b) {
  Unit product = {a.in_cgs * b.in_cgs, a.powers};
  for (std::size_t i = 0; i < product.powers.size(); ++i)
    product.powers[i] += b.powers[i];
  return product;
}

Unit power(const Unit& unit, double exponent) {
  Unit result = {std::pow(unit.in_cgs, exponent), unit.powers};
  for (double& p : result.powers)
    p *= exponent;
  return result;
}

bool same_dimension(const Unit& a, const Unit& b) {
  for (std::size_t i = 0; i < a.powers.size(); ++i) {
    if (std::abs(a.powers[i] - b.powers[i]) > 1e-6) return false;
  }
  return true;
}

UnitFactors unit_factors(const SnapshotInfo& snapshot) {
  UnitFactors factors;
  if (snapshot.cosmology) {
    factors.scale_factor = snapshot.cosmology->scale_factor;
  } else if (snapshot.redshift) {
    factors.scale_factor = 1 / (1 + *snapshot.redshift);
  }
  factors.hubble = snapshot.hubble_parameter.value_or(0);
  return factors;
}

Unit parse_unit(const std::string& text, const UnitFactors& factors, const std::string& what) {
  return Parser(text, factors, what).parse();
}

bool is_unit(const std::string& text) {
  try {
    parse_unit(text, UnitFactors{1, 1}, "");
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

namespace {

std::optional<Unit> known_unit(const std::string& text, const UnitFactors& factors) {
  try {
    return parse_unit(text, factors, "unit");
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

bool is_number(const Unit& unit) {
  return same_dimension(unit, Unit());
}

std::optional<double> ratio(const std::string& from, const std::string& to,
                            const UnitFactors& factors) {
  const std::optional<Unit> a = known_unit(from, factors), b = known_unit(to, factors);
  if (!a && !b) return 1;
  // Tables may number their columns: "x (1)".
  if (a && b && is_number(*a) && is_number(*b)) return 1;
  if (!a || !b || !same_dimension(*a, *b)) return std::nullopt;
  const double found = a->in_cgs / b->in_cgs;
  return std::isfinite(found) && found > 0 ? std::optional(found) : std::nullopt;
}

UnitFactors with_unknown(UnitFactors factors, double value) {
  if (!(factors.scale_factor > 0)) factors.scale_factor = value;
  if (!(factors.hubble > 0)) factors.hubble = value * value;
  return factors;
}

bool are_close(double a, double b) {
  constexpr double rounding = 1e-6;  // of the factors in the names
  return std::abs(a / b - 1) < rounding;
}

std::string unit_of(const ParticleTypeInfo& type, const char* field) {
  const FieldInfo* const info = find_field(type, field);
  return info == nullptr ? std::string() : info->unit;
}

}  // namespace

std::optional<double> unit_ratio(const std::string& from, const std::string& to,
                                 const UnitFactors& factors) {
  if (from.empty() || to.empty() || from == to) return 1;
  // Unknown a and h do no harm where they cancel.
  const auto found = ratio(from, to, with_unknown(factors, 1));
  const auto other = ratio(from, to, with_unknown(factors, 2));
  if (!found || !other || !are_close(*found, *other)) return std::nullopt;
  return are_close(*found, 1) ? 1 : found;
}

std::optional<double> ratio_of_known_units(const std::string& from, const std::string& to,
                                           const UnitFactors& factors) {
  if (from == to) return 1;
  const bool are_said = !from.empty() && !to.empty();
  // Of a unit that is not known nothing says that it is another one by 1.
  if (!are_said || !known_unit(from, with_unknown(factors, 1))) return std::nullopt;
  return unit_ratio(from, to, factors);
}

std::string unit_of_matching_density(const ParticleTypeInfo& type) {
  const std::string mass = unit_of(type, "mass"), length = unit_of(type, "position");
  if (mass.empty() || length.empty()) return {};
  return fmt::format("({}) ({})^-3", mass, length);
}

std::string unit_of_matching_volume(const ParticleTypeInfo& type) {
  const std::string length = unit_of(type, "position");
  return length.empty() ? length : fmt::format("({})^3", length);
}

}  // namespace splotchcl
