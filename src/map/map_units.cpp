#include "map/map_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/words.h"
#include "formula/formula.h"
#include "formula/formula_units.h"
#include "load/derived_fields.h"
#include "map/shape.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct UnitFactor {
  std::string name;
  double exponent = 1;
};

// "kpc^2"; nothing for numbers, products in parentheses and what is no unit.
std::optional<UnitFactor> unit_factor(const std::string& text) {
  const std::size_t mark = std::min(text.find('^'), text.size());
  UnitFactor factor{text.substr(0, mark), 1};
  if (factor.name.empty() || factor.name.find_first_of("()*0123456789") != std::string::npos)
    return std::nullopt;
  if (mark == text.size()) return factor;
  const auto exponent = parse_number(text.substr(mark + 1));
  if (!exponent) return std::nullopt;
  factor.exponent = *exponent;
  return factor;
}

// Factor by factor, "kpc h^-1 a" to the power -2 as "kpc^-2 h^2 a^-2": other programs read no power
// of a product.
std::string name_of_power(const std::string& unit, int exponent) {
  if (exponent == 1) return unit;
  std::string power;
  int sign = 1;
  for (std::size_t first = 0; first < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of(" /", first), unit.size());
    if (end > first) {
      const auto factor = unit_factor(unit.substr(first, end - first));
      if (!factor) return fmt::format("({})^{}", unit, exponent);
      const double all = sign * exponent * factor->exponent;
      power += (power.empty() ? "" : " ") + factor->name;
      if (all != 1) power += fmt::format("^{:g}", all);
      sign = 1;
    }
    if (end < unit.size() && unit[end] == '/') sign = -1;
    first = end + 1;
  }
  return power;
}

bool is_size(const Unit& unit) {
  return unit.in_cgs > 0 && std::isfinite(unit.in_cgs);
}

// What the snapshot, and the settings where it is silent, say of units.
class DataUnits {
 public:
  DataUnits(const MapSettings& settings, const SnapshotInfo& snapshot, int type)
      : settings_(settings), type_(*snapshot.find_type(type)), factors_(unit_factors(snapshot)) {}

  NamedUnits length() const {
    if (!settings_.length_unit.empty())
      return said(settings_.length_unit, "map.length_unit", "a length", "a kpc/h", "cm");
    return named("unit of position", unit_of("position"), "code_length");
  }
  NamedUnits mass() const {
    if (!settings_.mass_unit.empty())
      return said(settings_.mass_unit, "map.mass_unit", "a mass", "1e10 Msun/h", "g");
    return named("unit of mass", unit_of("mass"), "code_mass");
  }
  NamedUnits velocity() const {
    if (!settings_.velocity_unit.empty())
      return said(settings_.velocity_unit, "map.velocity_unit", "a velocity", "a^0.5 km/s", "cm/s");
    return named("unit of velocity", unit_of("velocity"), "code_velocity");
  }

  NamedUnits field(const std::string& name) const {
    const std::string canonical = canonical_field_name(name);
    if (name == "line_of_sight_velocity" || name == "speed") return velocity();
    if (const FieldInfo* const info = find_field(type_, name)) return of_field(*info);
    if (canonical == "temperature") return {"K", true, parse_unit("K", factors_, "unit")};
    if (canonical == "mass") return mass();
    if (canonical == "smoothing_length" || name == "radius") return length();
    if (canonical == "density") return product(mass(), length(), -3);
    if (const FieldInfo* const vectors = find_axis(type_, name).first) return of_field(*vectors);
    if (Formula::may_be(name)) return of_formula(name);
    return {"code_" + name, false, {}};
  }

  // Of what is no product of known units nothing tells what its values are in.
  NamedUnits of_formula(const std::string& text) const {
    const std::string what = "formula";
    const auto unit_of_field = [this](const std::string& name) -> std::optional<WrittenUnit> {
      const NamedUnits units = field(name);
      if (!units.is_known) return std::nullopt;
      return WrittenUnit{units.unit, {{units.name, 1}}};
    };
    const auto found = unit_of_formula(Formula::parse(text, what), unit_of_field, what);
    if (!found) return {"no_unit", false, {}};
    return {found->text(), true, found->unit};
  }

  // a * b^exponent
  static NamedUnits product(const NamedUnits& a, const NamedUnits& b, int exponent) {
    const bool is_one_name = b.name.find_first_of(" /*^()") == std::string::npos;
    const std::string name = is_one_name && exponent < 0
                                 ? fmt::format("{}/{}{}", a.name, b.name,
                                               exponent == -1 ? "" : fmt::format("^{}", -exponent))
                                 : a.name + " " + name_of_power(b.name, exponent);
    return {name, a.is_known && b.is_known, a.unit * power(b.unit, exponent)};
  }

  const UnitFactors& factors() const { return factors_; }

  // Also of what this map does not need.
  void check_settings() const {
    length();
    mass();
    velocity();
  }

 private:
  std::string unit_of(const char* field) const {
    const FieldInfo* const info = find_field(type_, field);
    return info == nullptr ? "" : info->unit;
  }
  NamedUnits of_field(const FieldInfo& info) const {
    if (info.name == "position" || info.name == "smoothing_length") return length();
    if (info.name == "mass") return mass();
    if (info.name == "velocity") return velocity();
    if (info.name == "density" && info.unit.empty()) return product(mass(), length(), -3);
    return named("unit of " + info.name, info.unit, "code_" + info.name);
  }
  // What the user says counts before what the file says: it may be wrong.
  NamedUnits said(const std::string& text, const std::string& key, const char* what,
                  const char* example, const char* in_cgs) const {
    const Unit unit = parse_unit(text, factors_, "key " + key);
    if (same_dimension(unit, parse_unit(in_cgs, {}, "unit")) && is_size(unit))
      return {text, true, unit};
    throw UsageError(fmt::format("key {}: found \"{}\", expected {} above 0, such as \"{}\"", key,
                                 text, what, example));
  }
  NamedUnits named(const std::string& what, const std::string& stored,
                   const std::string& code_name) const {
    if (stored.empty()) return {code_name, false, {}};
    // Files may call their units as they like: what we do not know is as good as none.
    try {
      const Unit unit = parse_unit(stored, factors_, what);
      return {stored, is_size(unit), unit};
    } catch (const UsageError&) {
      return {stored, false, {}};
    }
  }

  const MapSettings& settings_;
  const ParticleTypeInfo& type_;
  UnitFactors factors_;
};

NamedUnits unit_in_cells(MapShape shape, const DataUnits& data) {
  if (shape == MapShape::histogram) return data.mass();
  if (shape == MapShape::voxels || shape == MapShape::profile)
    return DataUnits::product(data.mass(), data.length(), -3);
  return DataUnits::product(data.mass(), {"sr", true, parse_unit("sr", {}, "unit")}, -1);
}

NamedUnits unit_of(const MapSettings& settings, const DataUnits& data, MapQuantity::Kind kind) {
  switch (kind) {
    case MapQuantity::Kind::counts:
      return {is_made_of_cells(shape_of(settings)) ? "particles" : "particles/pixel", false, {}};
    case MapQuantity::Kind::column:
      if (is_made_of_cells(shape_of(settings))) return unit_in_cells(shape_of(settings), data);
      return DataUnits::product(data.mass(), data.length(), settings.slice ? -3 : -2);
    case MapQuantity::Kind::integral:
      return DataUnits::product(data.field(settings.quantity), data.length(), 1);
    case MapQuantity::Kind::mean:
    case MapQuantity::Kind::dispersion:
      break;
  }
  return data.field(settings.quantity);
}

const char* what_is_missing(const std::string& unit) {
  if (is_unit(unit)) return "the numbers for a and h";
  const bool is_unsaid = unit.find("code_") != std::string::npos || unit == "no_unit";
  return is_unsaid ? "its units" : "units that are known";
}

[[noreturn]] void refuse_unknown(const std::string& wanted, const NamedUnits& found) {
  const bool is_count = found.name.rfind("particles", 0) == 0;
  if (is_count) {
    throw UsageError(
        fmt::format("key map.unit: found \"{}\", but the map is in {}, expected no unit for counts",
                    wanted, found.name));
  }
  throw UsageError(fmt::format(
      "key map.unit: found \"{}\", but the map is in {}, since the snapshot does not say {}, "
      "expected them; set map.length_unit, map.mass_unit and map.velocity_unit, as far as the "
      "quantity needs them",
      wanted, found.name, what_is_missing(found.name)));
}

[[noreturn]] void refuse_unknown_length(const std::string& found, const NamedUnits& length,
                                        const std::string& what) {
  throw UsageError(
      fmt::format("{}: found \"{}\", but the snapshot's lengths are in {}, which is not known, "
                  "expected numbers "
                  "alone; or set map.length_unit, such as \"a kpc/h\"",
                  what, found, length.name));
}

// The field whose values the map's quantity or weight is made of; null where there is none.
const FieldInfo* source_of(const ParticleTypeInfo& type, const std::string& name) {
  if (name.empty()) return nullptr;
  if (name == "line_of_sight_velocity" || name == "speed") return find_field(type, "velocity");
  if (const FieldInfo* const field = find_field(type, name)) return field;
  return find_axis(type, name).first;
}

void add_names(const std::string& quantity, const ParticleTypeInfo& type,
               std::vector<std::string>& names) {
  names.push_back(quantity);
  if (source_of(type, quantity) != nullptr || !Formula::may_be(quantity)) return;
  const Formula formula = Formula::parse(quantity, "formula");
  names.insert(names.end(), formula.fields().begin(), formula.fields().end());
}

std::vector<std::string> names_with_units(const MapSettings& settings,
                                          const ParticleTypeInfo& type) {
  std::vector<std::string> names = {"position", "smoothing_length", "mass"};
  add_names(settings.quantity, type, names);
  add_names(settings.weight, type, names);
  return names;
}

// Values of several types are added: they need one unit.
void check_types_agree(const MapSettings& settings, const SnapshotInfo& snapshot,
                       const std::vector<int>& types) {
  const ParticleTypeInfo& first = *snapshot.find_type(types.front());
  for (const int number : types) {
    const ParticleTypeInfo& type = *snapshot.find_type(number);
    for (const std::string& name : names_with_units(settings, first)) {
      const FieldInfo *const one = source_of(first, name), *const other = source_of(type, name);
      if (one == nullptr || other == nullptr) continue;
      const auto ratio = unit_ratio(other->unit, one->unit, unit_factors(snapshot));
      constexpr double rounding = 1e-3;
      if (ratio && std::abs(*ratio - 1) < rounding) continue;
      throw UsageError(
          fmt::format("key component.types: found types {} and {}, whose {} is in \"{}\" and in "
                      "\"{}\", expected "
                      "types in the same unit; draw a map of each",
                      first.type, type.type, one->name, one->unit, other->unit));
    }
  }
}

void set_lengths_to(const std::string& name, const NamedUnits& length, MapUnits& units) {
  const Unit known = parse_unit(name, {}, "key map.axis_unit");
  units.length_name = name;
  units.length_factor = length.unit.in_cgs / known.in_cgs;
  units.length_in_cgs = known.in_cgs;
}

// In the unit that is asked for, or the largest one that the map is as wide as: without a and h, by
// a name that other programs know.
void set_lengths(const MapSettings& settings, const DataUnits& data, double width,
                 MapUnits& units) {
  const NamedUnits length = data.length();
  const Unit centimeter = parse_unit("cm", {}, "unit");
  units.length_name = length.name;
  const bool is_known = length.is_known && same_dimension(length.unit, centimeter);
  if (!settings.axis_unit.empty()) {
    const Unit wanted = parse_unit(settings.axis_unit, {}, "key map.axis_unit");
    if (!same_dimension(wanted, centimeter) || !is_size(wanted)) {
      throw UsageError(
          fmt::format("key map.axis_unit: found \"{}\", expected a unit of length, such as Mpc",
                      settings.axis_unit));
    }
    if (!is_known) refuse_unknown_length(settings.axis_unit, length, "key map.axis_unit");
    set_lengths_to(settings.axis_unit, length, units);
    return;
  }
  if (!is_known) return;
  for (const char* const name : {"Gpc", "Mpc", "kpc", "pc", "AU", "km"}) {
    set_lengths_to(name, length, units);
    if (width * units.length_factor >= 1) return;
  }
  set_lengths_to("cm", length, units);
}

}  // namespace

std::string name_of_density(const ParticleTypeInfo& type) {
  const FieldInfo *const mass = find_field(type, "mass"), *const position =
                                                              find_field(type, "position");
  if (mass == nullptr || position == nullptr || mass->unit.empty() || position->unit.empty())
    return {};
  return DataUnits::product({mass->unit, true, {}}, {position->unit, true, {}}, -3).name;
}

double length_in_snapshot(const std::string& text, const MapSettings& settings,
                          const SnapshotInfo& snapshot, int type, const std::string& what) {
  if (const std::optional<double> number = parse_number(text)) return *number;
  const DataUnits data(settings, snapshot, type);
  const NamedUnits length = data.length();
  const Unit given = parse_unit(text, data.factors(), what);
  const Unit centimeter = parse_unit("cm", {}, "unit");
  if (!same_dimension(given, centimeter) || end_of_number(text) == 0) {
    throw UsageError(fmt::format(
        "{}: found \"{}\", expected a number, or a length such as \"4 Mpc\"", what, text));
  }
  if (!length.is_known || !same_dimension(length.unit, centimeter))
    refuse_unknown_length(text, length, what);
  return given.in_cgs / length.unit.in_cgs;
}

std::string unit_of_field(const std::string& name, const MapSettings& settings,
                          const SnapshotInfo& snapshot, int type) {
  return DataUnits(settings, snapshot, type).field(name).name;
}

double velocity_in_cgs(const MapSettings& settings, const SnapshotInfo& snapshot, int type,
                       const std::string& what) {
  const NamedUnits velocity = DataUnits(settings, snapshot, type).velocity();
  if (velocity.is_known) return velocity.unit.in_cgs;
  throw UsageError(
      fmt::format("{}: the snapshot does not say its unit of velocity, expected it; set "
                  "map.velocity_unit, such "
                  "as \"km/s\"",
                  what));
}

std::pair<std::string, double> told_velocity(const MapSettings& settings,
                                             const SnapshotInfo& snapshot, int type) {
  constexpr double kilometer = 1e5;
  const NamedUnits velocity = DataUnits(settings, snapshot, type).velocity();
  if (!velocity.is_known) return {velocity.name, 1};
  return {"km/s", velocity.unit.in_cgs / kilometer};
}

MapUnits decide_units(const MapSettings& settings, const SnapshotInfo& snapshot,
                      const std::vector<int>& types, MapQuantity::Kind kind, double width) {
  check_types_agree(settings, snapshot, types);
  const DataUnits data(settings, snapshot, types.front());
  data.check_settings();
  const NamedUnits found = unit_of(settings, data, kind);
  MapUnits units;
  units.name = found.name;
  set_lengths(settings, data, width, units);
  if (settings.unit.empty() || settings.unit == found.name) return units;
  const Unit wanted = parse_unit(settings.unit, data.factors(), "key map.unit");
  if (!is_size(wanted)) {
    throw UsageError(fmt::format(
        "key map.unit: found \"{}\", expected a unit above 0, such as Msun/pc^2", settings.unit));
  }
  if (!found.is_known) refuse_unknown(settings.unit, found);
  if (!same_dimension(wanted, found.unit)) {
    throw UsageError(fmt::format(
        "key map.unit: found \"{}\", expected a unit of the same dimension as the map's, {}",
        settings.unit, found.name));
  }
  units.name = settings.unit;
  units.factor = found.unit.in_cgs / wanted.in_cgs;
  return units;
}

}  // namespace splotchcl
