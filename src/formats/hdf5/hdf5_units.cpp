#include "formats/hdf5/hdf5_units.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "formats/hdf5/gadget_hdf5_header.h"
#include "formats/table.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

struct NamedUnit {
  double in_cgs;
  const char* name;
};

const std::vector<NamedUnit>& lengths() {
  static const std::vector<NamedUnit> units = {{3.0857e24, "Mpc"},  {3.0857e21, "kpc"},
                                               {3.0857e18, "pc"},   {1.4960e13, "au"},
                                               {6.957e10, "R_sun"}, {1, "cm"}};
  return units;
}

const std::vector<NamedUnit>& masses() {
  static const std::vector<NamedUnit> units = {
      {1.989e43, "1e10 M_sun"}, {1.989e33, "M_sun"}, {1, "g"}};
  return units;
}

const std::vector<NamedUnit>& velocities() {
  static const std::vector<NamedUnit> units = {{1e5, "km/s"}, {1, "cm/s"}};
  return units;
}

bool are_close(double a, double b) {
  // Codes round their constants to four digits.
  return std::abs(a / b - 1) < 1e-3;
}

std::string base_name(double in_cgs, const std::vector<NamedUnit>& known) {
  for (const NamedUnit& unit : known) {
    if (are_close(in_cgs, unit.in_cgs)) return unit.name;
  }
  return fmt::format("{:.7g} {}", in_cgs, known.back().name);
}

void append_power(std::string& text, std::string base, double power) {
  if (power == 0) return;
  if (!text.empty()) text += ' ';
  const bool is_compound = base.find_first_of(" /") != std::string::npos;
  if (is_compound && power != 1) base = "(" + base + ")";
  text += power == 1 ? base : fmt::format("{}^{:g}", base, power);
}

// Of the product of these powers of the base units; 0 where one of these is unknown.
double size_in_cgs(const UnitPowers& powers, const BaseUnits& units) {
  const auto factor = [](double base, double power) {
    return power == 0 ? 1 : std::pow(base, power);
  };
  const double size = factor(units.length_in_cm, powers.length) *
                      factor(units.mass_in_g, powers.mass) *
                      factor(units.velocity_in_cm_per_s, powers.velocity);
  return std::isfinite(size) ? size : 0;
}

bool has_only(const UnitPowers& powers, double UnitPowers::*kept) {
  UnitPowers others = powers;
  others.*kept = 0;
  return others.length == 0 && others.mass == 0 && others.velocity == 0 && others.temperature == 0;
}

// A unit of this size, by the names of base units where it is a power of one.
std::string name_of_size(const UnitPowers& powers, double in_cgs) {
  std::string text;
  const auto append_named = [&](double power, const std::vector<NamedUnit>& known) {
    append_power(text, base_name(std::pow(in_cgs, 1 / power), known), power);
    return text;
  };
  if (has_only(powers, &UnitPowers::length)) return append_named(powers.length, lengths());
  if (has_only(powers, &UnitPowers::mass)) return append_named(powers.mass, masses());
  if (has_only(powers, &UnitPowers::velocity)) return append_named(powers.velocity, velocities());
  // A velocity is a length over a time.
  const double length = powers.length + powers.velocity, time = -powers.velocity;
  const bool is_rate_of_mass =
      powers.mass == 1 && length == 0 && time == -1 && powers.temperature == 0;
  constexpr double solar_masses_per_year = 1.989e33 / 3.15576e7;
  if (is_rate_of_mass && are_close(in_cgs, solar_masses_per_year)) return "M_sun/yr";
  text = fmt::format("{:.7g}", in_cgs);
  append_power(text, "g", powers.mass);
  append_power(text, "cm", length);
  append_power(text, "s", time);
  append_power(text, "K", powers.temperature);
  return text;
}

}  // namespace

std::string unit_name(const UnitPowers& powers, const BaseUnits& units, double stated_in_cgs) {
  const bool is_pure_number =
      powers.length == 0 && powers.mass == 0 && powers.velocity == 0 && powers.temperature == 0;
  if (is_pure_number) return {};
  const double product = size_in_cgs(powers, units);
  const bool is_stated = stated_in_cgs > 0 && std::isfinite(stated_in_cgs);
  std::string text;
  if (is_stated && !(product > 0 && are_close(product, stated_in_cgs))) {
    text = name_of_size(powers, stated_in_cgs);
  } else if (product > 0) {
    append_power(text, base_name(units.mass_in_g, masses()), powers.mass);
    append_power(text, base_name(units.length_in_cm, lengths()), powers.length);
    append_power(text, base_name(units.velocity_in_cm_per_s, velocities()), powers.velocity);
    append_power(text, "K", powers.temperature);
  } else {
    return {};
  }
  append_power(text, "h", powers.hubble);
  append_power(text, "a", powers.scale_factor);
  return text;
}

UnitPowers powers_of_field(const std::string& field) {
  UnitPowers powers;
  if (field == "position" || field == "smoothing_length") {
    powers.length = 1;
  } else if (field == "mass") {
    powers.mass = 1;
  } else if (field == "density") {
    powers.mass = 1;
    powers.length = -3;
  } else if (field == "velocity") {
    powers.velocity = 1;
  } else if (field == "internal_energy") {
    powers.velocity = 2;
  } else if (field == "temperature") {
    powers.temperature = 1;
  }
  return powers;
}

namespace {

// The first of these attributes that is a number.
std::optional<double> find_power(const Hdf5File& file, const std::string& dataset,
                                 const std::vector<const char*>& attributes) {
  for (const char* const attribute : attributes) {
    if (const auto number = file.number(dataset, attribute)) return number;
  }
  return std::nullopt;
}

// SWIFT keeps some values as they are in physical coordinates; the exponent then tells what would
// make them comoving.
bool are_stored_as_physical(const Hdf5File& file, const std::string& dataset) {
  return file.number(dataset, "Value stored as physical").value_or(0) != 0;
}

// Of Gadget 4, AREPO and SWIFT, which say what a field is a product of.
UnitPowers stated_powers(const Hdf5File& file, const std::string& dataset) {
  const auto power = [&](const std::vector<const char*>& attributes) {
    return find_power(file, dataset, attributes).value_or(0);
  };
  UnitPowers powers;
  powers.mass = power({"mass_scaling", "U_M exponent"});
  powers.temperature = power({"temperature_scaling", "U_T exponent"});
  // A time is a length over a velocity.
  const double time = power({"U_t exponent"});
  powers.length = power({"length_scaling", "U_L exponent"}) + time;
  powers.velocity = power({"velocity_scaling"}) - time;
  return powers;
}

// Where a file states the size of a unit, but not of what it is one, as EAGLE's do.
UnitPowers powers_by_name(const std::string& label) {
  const std::string field = canonical_field_name(label);
  if (field != "star_formation_rate") return powers_of_field(field);
  UnitPowers powers;
  powers.mass = powers.velocity = 1;
  powers.length = -1;
  return powers;
}

bool states_powers(const Hdf5File& file, const std::string& dataset) {
  return find_power(file, dataset,
                    {"mass_scaling", "length_scaling", "velocity_scaling", "U_M exponent",
                     "U_L exponent", "U_t exponent", "U_T exponent"})
      .has_value();
}

}  // namespace

std::optional<double> read_scale_factor_power(const Hdf5File& file, const std::string& dataset) {
  const auto power =
      find_power(file, dataset, {"a_scaling", "a-scale exponent", "aexp-scale-exponent"});
  return power && are_stored_as_physical(file, dataset) ? 0 : power;
}

UnitsOfFile read_units(const Hdf5File& file) {
  return {read_base_units(file), !is_without_cosmology(file)};
}

std::string read_unit_in_words(const Hdf5File& file, const std::string& object) {
  for (const char* attribute : {"units", "unit", "Units", "Unit"}) {
    const auto unit = file.text(object, attribute);
    if (unit && !unit->empty() && *unit != "dimensionless") return in_our_units(*unit);
  }
  return {};
}

std::string read_field_unit(const Hdf5File& file, const Hdf5Dataset& dataset,
                            const UnitsOfFile& units) {
  const std::string& path = dataset.path;
  // We have no name for currents.
  if (file.number(path, "U_I exponent").value_or(0) != 0) return {};
  const double size =
      find_power(file, path, {size_in_eagle, size_in_gadget, size_in_swift}).value_or(0);
  const bool goes_by_name = size > 0 && !states_powers(file, path);
  UnitPowers powers = goes_by_name ? powers_by_name(dataset.label()) : stated_powers(file, path);
  if (units.has_scale_factor) powers.scale_factor = read_scale_factor_power(file, path).value_or(0);
  powers.hubble =
      find_power(file, path, {"h_scaling", "h-scale exponent", "h-scale-exponent"}).value_or(0);
  const std::string unit = unit_name(powers, units.base, size);
  return unit.empty() && !states_powers(file, path) ? read_unit_in_words(file, path) : unit;
}

namespace {

// GIZMO divides its units of length and mass by it before it writes them.
double hubble_parameter(const Hdf5File& file) {
  const double hubble = file.number("Header", "HubbleParam").value_or(1);
  return hubble > 0 ? hubble : 1;
}

bool is_comoving(const Hdf5File& file, const SnapshotInfo& info) {
  const auto stated = file.number("Header", "ComovingIntegrationOn");
  return stated ? *stated != 0 : info.cosmology.has_value();
}

// What GIZMO writes: comoving lengths, and velocities over the root of the scale factor.
UnitPowers gizmo_powers_of(const std::string& field) {
  UnitPowers powers = powers_of_field(field);
  powers.scale_factor = field == "velocity" ? 0.5 : powers.length;
  return powers;
}

}  // namespace

bool has_gizmo_units(const Hdf5File& file) {
  return file.number("Header", "UnitLength_In_CGS").has_value();
}

BaseUnits read_gizmo_units(const Hdf5File& file) {
  const double hubble = hubble_parameter(file);
  BaseUnits units;
  units.length_in_cm = hubble * file.number("Header", "UnitLength_In_CGS").value_or(0);
  units.mass_in_g = hubble * file.number("Header", "UnitMass_In_CGS").value_or(0);
  units.velocity_in_cm_per_s = file.number("Header", "UnitVelocity_In_CGS").value_or(0);
  return units;
}

void name_gizmo_units(const Hdf5File& file, SnapshotInfo& info) {
  const BaseUnits units = read_gizmo_units(file);
  const bool has_hubble = hubble_parameter(file) != 1;
  const bool has_scale_factor = is_comoving(file, info);
  for (ParticleTypeInfo& type : info.types) {
    for (FieldInfo& field : type.fields) {
      UnitPowers powers = gizmo_powers_of(field.name);
      if (has_hubble) powers.hubble = -powers.length - powers.mass;
      if (!has_scale_factor) powers.scale_factor = 0;
      field.unit = unit_name(powers, units);
    }
  }
}

}  // namespace splotchcl
