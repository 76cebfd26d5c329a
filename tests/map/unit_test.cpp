#include "snapshot/unit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using testing::HasSubstr;

constexpr UnitFactors none;

double ratio(const std::string& from, const std::string& to, const UnitFactors& factors = none) {
  const Unit a = parse_unit(from, factors, "from"), b = parse_unit(to, factors, "to");
  EXPECT_TRUE(same_dimension(a, b)) << from << " and " << to;
  return a.in_cgs / b.in_cgs;
}

std::string refusal(const std::string& text) {
  try {
    parse_unit(text, none, "key map.unit");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Units, MultiplyDivideAndTakePowers) {
  EXPECT_NEAR(ratio("km/s", "cm s^-1"), 1e5, 1e-6);
  EXPECT_NEAR(ratio("kpc^2", "pc^2"), 1e6, 1e-3);
  EXPECT_NEAR(ratio("(km/s)^2", "cm^2/s^2"), 1e10, 1);
  EXPECT_NEAR(ratio("erg/cm^3", "g/cm/s^2"), 1, 1e-12);
}

// GM_sun / G / pc^2: 2.0885e-4 g/cm^2, as tables have it.
TEST(Units, KnowASolarMassPerSquareParsec) {
  EXPECT_NEAR(ratio("Msun/pc^2", "g/cm^2"), 2.0884e-4, 1e-8);
}

TEST(Units, KnowThoseOfLight) {
  EXPECT_NEAR(ratio("Lsun", "erg/s"), 3.828e33, 1e24);
  EXPECT_NEAR(ratio("solLum", "W"), 3.828e26, 1e17);
  EXPECT_NEAR(ratio("Jy", "W Hz^-1 m^-2"), 1e-26, 1e-38);
  EXPECT_NEAR(ratio("GHz", "s^-1"), 1e9, 1e-3);
  EXPECT_NEAR(ratio("keV", "erg"), 1.602176634e-9, 1e-20);
}

TEST(Units, KnowLightYearsGaussesAndAngles) {
  EXPECT_NEAR(ratio("pc", "ly"), 3.261563777, 1e-8);
  EXPECT_NEAR(ratio("G^2", "erg/cm^3"), 1, 1e-12);
  EXPECT_NEAR(ratio("deg", "arcsec"), 3600, 1e-9);
  EXPECT_NEAR(ratio("erg/s/cm^2/arcsec^2", "erg s^-1 cm^-2 sr^-1"), 4.25451703e10, 10);
}

TEST(Units, MayFollowANumberAtOnce) {
  EXPECT_NEAR(ratio("4Mpc", "kpc"), 4000, 1e-9);
  EXPECT_NEAR(ratio("1e-3Gyr", "Myr"), 1, 1e-12);
  EXPECT_NEAR(ratio("4 erg", "erg"), 4, 1e-12);
  EXPECT_NEAR(ratio("2eV", "eV"), 2, 1e-12);
}

TEST(Units, ReadWhatTheReadersWrite) {
  EXPECT_NEAR(ratio("1e10 M_sun Mpc^-3 a^-3", "Msun/pc^3", {0.5, 0}), 8e10 / 1e18, 1e-18);
  EXPECT_NEAR(ratio("(1e10 M_sun)^-0.666667 Mpc^2 (km/s)^2", "Msun^-0.666667 pc^2 cm^2/s^2"),
              std::pow(1e10, -0.666667) * 1e12 * 1e10, 1e12);
}

TEST(Units, AreReadAsFitsFilesHaveThem) {
  const UnitFactors factors = {0.25, 0.7};
  for (const char* const unit : {"1e10 M_sun Mpc^-2", "R_sun^2", "a^-2 kpc/h", "(km/s)^2"})
    EXPECT_NEAR(ratio(fits_unit(unit), unit, factors), 1, 1e-12) << unit;
}

TEST(Units, TakeAAndHOfTheSnapshot) {
  EXPECT_NEAR(ratio("a kpc/h", "kpc", {0.25, 0.7}), 0.25 / 0.7, 1e-12);
}

TEST(Units, RefuseHWhereItIsNotKnown) {
  EXPECT_THAT(refusal("kpc/h"), HasSubstr("key map.unit: found h"));
}

TEST(Units, RefuseUnknownNamesWithTheNearest) {
  EXPECT_THAT(refusal("Msum/pc^2"), HasSubstr("did you mean Msun?"));
}

TEST(Units, RefuseWhatIsNoProduct) {
  for (const char* const text : {"", "/", "km/", "(km", "km)", "km^", "km^x", "1e400 km"})
    EXPECT_NE(refusal(text), "") << text;
}

}  // namespace
}  // namespace splotchcl
