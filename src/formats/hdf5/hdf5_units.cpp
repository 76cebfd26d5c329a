#include "formats/hdf5/hdf5_units.h"

#include <string>
#include <vector>

#include "formats/hdf5/gadget_hdf5_header.h"
#include "snapshot/field_names.h"

namespace splotchcl {
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
    if (unit && !unit->empty() && *unit != "dimensionless") return *unit;
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
