#include "formats/hdf5/gizmo_units.h"

#include <string>

namespace splotchcl {
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
