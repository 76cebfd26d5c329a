#pragma once

#include <string>

namespace splotchcl {

// A unit as the FITS standard (4.0, section 4.3) writes it: "1e10 M_sun/kpc^2" as
// "10**10 solMass/kpc**2". There "a" is a year and "h" an hour: the scale factor and the Hubble
// parameter become "scale_factor" and "little_h", which readers take for unknown units, not for
// wrong ones.
std::string fits_unit(const std::string& unit);

// A unit that other programs can read, and what numbers have to be multiplied by to be in it.
struct FitsUnit {
  std::string text;
  double factor = 1;
};

// fits_unit(), but where the standard has no numbers, products or names like those of this unit
// and its size is known: powers of g, cm, s and K with a power of ten, so that the factor is
// between 1 and 10.
FitsUnit readable_fits_unit(const std::string& unit);

}  // namespace splotchcl
