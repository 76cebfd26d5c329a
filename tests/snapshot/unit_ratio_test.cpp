#include <gtest/gtest.h>

#include "snapshot/unit.h"

namespace splotchcl {
namespace {

TEST(UnitRatio, ConvertsWhatIsKnown) {
  const auto found = unit_ratio("g/cm^3", "(Msun) (kpc)^-3", {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found * 6.7679e-32, 1, 1e-4);
  EXPECT_EQ(unit_ratio("1e10 M_sun kpc^-3", "(1e10 M_sun) (kpc)^-3", {}), 1.0);
}

TEST(UnitRatio, IsOneWhereNothingTellsUnitsApart) {
  EXPECT_EQ(unit_ratio("", "g", {}), 1.0);
  EXPECT_EQ(unit_ratio("g", "", {}), 1.0);
  EXPECT_EQ(unit_ratio("2", "1", {}), 1.0);
  EXPECT_EQ(unit_ratio("1", "0", {}), 1.0);
  EXPECT_EQ(unit_ratio("code_mass", "code_mass", {}), 1.0);
  EXPECT_EQ(unit_ratio("code_mass/code_length**3", "(code_mass) (code_length)^-3", {}), 1.0);
}

TEST(UnitRatio, IsNotKnownOfOtherDimensionsAndOfOneKnownUnit) {
  EXPECT_FALSE(unit_ratio("K", "kpc", {}));
  EXPECT_FALSE(unit_ratio("code_length", "kpc", {}));
}

TEST(UnitRatio, NeedsScaleFactorAndHubbleParameterUnlessTheyCancel) {
  EXPECT_EQ(unit_ratio("M_sun kpc^-3 h^2 a^-3", "(M_sun h^-1) (kpc h^-1 a)^-3", {}), 1.0);
  EXPECT_FALSE(unit_ratio("kpc a", "kpc", {}));
  EXPECT_NEAR(unit_ratio("kpc a", "kpc", {0.25, 0}).value_or(0), 0.25, 1e-12);
}

}  // namespace
}  // namespace splotchcl
