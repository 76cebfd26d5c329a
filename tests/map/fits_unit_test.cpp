#include <gtest/gtest.h>

#include "map/map_files.h"

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

TEST(FitsUnits, ThatNoProgramReadsAreWrittenInPlainOnes) {
  const FitsUnit squares = readable_fits_unit("(km/s)^2");
  EXPECT_EQ(squares.text, "10**10 cm**2 s**-2");
  EXPECT_NEAR(squares.factor, 1, 1e-12);
  const FitsUnit number = readable_fits_unit("2.5e+20 cm");
  EXPECT_EQ(number.text, "10**20 cm");
  EXPECT_NEAR(number.factor, 2.5, 1e-12);
  EXPECT_EQ(readable_fits_unit("K kpc^0.5").text, "10**10 cm**(0.5) K");
  const FitsUnit tens = readable_fits_unit("40 g/cm^2");
  EXPECT_EQ(tens.text, "g cm**-2") << "10 alone is no number of the standard's";
  EXPECT_NEAR(tens.factor, 40, 1e-12);
  EXPECT_EQ(readable_fits_unit("2 K").text, "K");
  EXPECT_EQ(readable_fits_unit("2 K").factor, 2);
}

TEST(FitsUnits, ThatAreReadStayAsTheyAre) {
  for (const char* const unit :
       {"1e10 M_sun kpc^-2", "M_sun/yr", "count/pixel", "K", "particles/pixel", "(kpc h^-1 a)^-2",
        "code_mass/code_length^2", "Mpc^-2 a^-2"}) {
    EXPECT_EQ(readable_fits_unit(unit).text, fits_unit(unit));
    EXPECT_EQ(readable_fits_unit(unit).factor, 1);
  }
}

TEST(FitsUnits, LeaveOtherNamesAlone) {
  EXPECT_EQ(fits_unit("code_mass/code_length^2"), "code_mass/code_length**2");
  EXPECT_EQ(fits_unit("erg/s/cm^2"), "erg/s/cm**2");
}

}  // namespace
}  // namespace splotchcl
