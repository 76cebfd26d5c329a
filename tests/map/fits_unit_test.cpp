#include "map/fits_unit.h"

#include <gtest/gtest.h>

namespace splotchcl {
namespace {

TEST(FitsUnits, HaveTheNamesOfTheStandard) {
  EXPECT_EQ(fits_unit("Msun/pc^2"), "solMass/pc**2");
  EXPECT_EQ(fits_unit("1e10 M_sun kpc^-2"), "10**10 solMass kpc**-2");
  EXPECT_EQ(fits_unit("particles/pixel"), "count/pixel");
}

TEST(FitsUnits, TakeNoScaleFactorForAYear) {
  EXPECT_EQ(fits_unit("Mpc^-2 a^-2"), "Mpc**-2 scale_factor**-2");
  EXPECT_EQ(fits_unit("kpc/h"), "kpc/little_h");
}

TEST(FitsUnits, LeaveOtherNamesAlone) {
  EXPECT_EQ(fits_unit("code_mass/code_length^2"), "code_mass/code_length**2");
  EXPECT_EQ(fits_unit("erg/s/cm^2"), "erg/s/cm**2");
}

}  // namespace
}  // namespace splotchcl
