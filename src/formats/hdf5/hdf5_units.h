#pragma once

#include <optional>
#include <string>

#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A field's unit as powers of base units, each given in cgs; a base unit of 0 is unknown.
struct UnitPowers {
  double length = 0, mass = 0, velocity = 0;
  double temperature = 0;   // in kelvin
  double scale_factor = 0;  // comoving quantities
  double hubble = 0;
};
struct BaseUnits {
  double length_in_cm = 0;
  double mass_in_g = 0;
  double velocity_in_cm_per_s = 0;
};

// For example "kpc h^-1 a". Empty when a base unit that the field needs is unknown or when
// the field is a pure number. Where the size of the unit is stated as another one than the product
// of these powers, it counts.
std::string unit_name(const UnitPowers& powers, const BaseUnits& units, double stated_in_cgs = 0);

// What a field of this canonical name is a product of, without a and h; a pure number where that is
// not known.
UnitPowers powers_of_field(const std::string& field);

// Attributes of a dataset that state how large its unit is in cgs.
constexpr const char* size_in_gadget = "to_cgs";  // of Gadget 4 and AREPO
constexpr const char* size_in_eagle = "CGSConversionFactor";
constexpr const char* size_in_swift =
    "Conversion factor to CGS (not including cosmological corrections)";

// The power of the scale factor that makes a dataset's values physical, where its attributes say
// it.
std::optional<double> read_scale_factor_power(const Hdf5File& file, const std::string& dataset);

// What a file says of all its fields' units.
struct UnitsOfFile {
  BaseUnits base;
  // Without cosmology there is none that a unit could have powers of.
  bool has_scale_factor = true;
};
UnitsOfFile read_units(const Hdf5File& file);

// What an attribute "units" or "unit" says; empty where there is none.
std::string read_unit_in_words(const Hdf5File& file, const std::string& object);

// The unit that the attributes of a dataset of Gadget 4, AREPO, SWIFT or EAGLE state, else what
// read_unit_in_words() finds. Empty where they state none.
std::string read_field_unit(const Hdf5File& file, const Hdf5Dataset& dataset,
                            const UnitsOfFile& units);

// Whether the header states units as GIZMO does since 2020: UnitLength_In_CGS, UnitMass_In_CGS,
// UnitVelocity_In_CGS.
bool has_gizmo_units(const Hdf5File& file);

// The units that GIZMO computes in before they are divided by the Hubble parameter, which the
// attributes contain: fields have a power of h for it.
BaseUnits read_gizmo_units(const Hdf5File& file);

// Names the units of fields by what they are, since GIZMO's datasets state none: positions and
// smoothing lengths, masses, densities, velocities, internal energies, temperatures. Reads which
// factors of a and h they have from the header, and from whether the run is cosmological.
void name_gizmo_units(const Hdf5File& file, SnapshotInfo& info);

}  // namespace splotchcl
