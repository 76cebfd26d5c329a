#pragma once

#include <string>

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

}  // namespace splotchcl
