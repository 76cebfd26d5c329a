#include "map/gas.h"
#include "map/map_files.h"
#include "map/map_units.h"
#include "map/place.h"
#include "snapshot/unit.h"
#include "splotchcl/map.h"
#include "testing.h"

namespace splotchcl {
namespace {

constexpr UnitFactors none;

double ratio(const std::string& from, const std::string& to, const UnitFactors& factors = none) {
  const Unit a = parse_unit(from, factors, "from"), b = parse_unit(to, factors, "to");
  EXPECT_TRUE(same_dimension(a, b)) << from << " and " << to;
  return a.in_cgs / b.in_cgs;
}

std::string refusal(const std::string& text) {
  return test::refusal_by<UsageError>([&] { parse_unit(text, none, "key map.unit"); });
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

constexpr double hubble_distance = 299792.458 / 70;  // in Mpc

SnapshotInfo at(double redshift, double omega_matter, double omega_lambda) {
  SnapshotInfo snapshot;
  snapshot.hubble_parameter = 0.7;
  snapshot.cosmology.emplace();
  snapshot.cosmology->scale_factor = 1 / (1 + redshift);
  snapshot.cosmology->omega_matter = omega_matter;
  snapshot.cosmology->omega_lambda = omega_lambda;
  return snapshot;
}

// Without a cosmological constant Mattig's formula is exact.
double mattig(double z, double omega) {
  const double bracket = omega * z + (omega - 2) * (std::sqrt(1 + omega * z) - 1);
  return 2 * hubble_distance * bracket / std::pow(omega * (1 + z), 2);
}

TEST(AngularDistance, IsMattigsWithoutACosmologicalConstant) {
  for (const double omega : {0.3, 1.0, 1.7}) {
    for (const double z : {0.01, 1.0, 3.0, 100.0})
      EXPECT_NEAR(angular_distance_in_mpc(at(z, omega, 0)) / mattig(z, omega), 1, 1e-9);
  }
}

// 4282.7494 Mpc * 0.7714271 / 2, with the integral of dz / sqrt(0.3 (1 + z)^3 + 0.7) in 200000
// steps.
TEST(AngularDistance, OfAFlatUniverseIsTheIntegralOverTwo) {
  EXPECT_NEAR(angular_distance_in_mpc(at(1, 0.3, 0.7)), 1651.914, 0.01);
}

TEST(AngularDistance, IsRefusedWhereItDoesNotFollow) {
  EXPECT_THROW(angular_distance_in_mpc(at(0, 0.3, 0.7)), UsageError);
  EXPECT_THROW(angular_distance_in_mpc(SnapshotInfo()), UsageError);
  SnapshotInfo snapshot = at(1, 0.3, 0.7);
  snapshot.hubble_parameter.reset();
  EXPECT_THROW(angular_distance_in_mpc(snapshot), UsageError);
}

// Of a run at a = 0.5 and h = 0.7.
SnapshotInfo in_comoving_kpc() {
  SnapshotInfo info;
  info.redshift = 1;
  info.hubble_parameter = 0.7;
  ParticleTypeInfo gas;
  gas.type = 0;
  FieldInfo position;
  position.name = "position";
  position.unit = "a kpc/h";
  gas.fields = {position};
  info.types = {gas};
  return info;
}

double length_of(const std::string& text, const SnapshotInfo& info = in_comoving_kpc()) {
  return length_in_snapshot(text, {}, info, 0, "option --width");
}

TEST(MapLength, WithAUnitIsConvertedToTheSnapshots) {
  EXPECT_NEAR(length_of("4Mpc"), 4000 * 0.7 / 0.5, 1e-9);
  EXPECT_NEAR(length_of("4 Mpc"), length_of("4Mpc"), 1e-9);
  EXPECT_NEAR(length_of("4e3kpc"), length_of("4Mpc"), 1e-9);
  EXPECT_NEAR(length_of("-2.5 a kpc/h"), -2.5, 1e-12);
  EXPECT_NEAR(length_of("3.2615637771675 ly"), length_of("1 pc"), 1e-8);
}

TEST(MapLength, OfANumberAloneIsTheSnapshots) {
  EXPECT_EQ(length_of("4000"), 4000);
  EXPECT_EQ(length_of("4000", {}), 4000);
}

TEST(MapLength, HasToBeALength) {
  for (const char* const text : {"4 Msun", "Mpc", "4 parsecs", ""}) {
    EXPECT_THAT([&] { length_of(text); }, ThrowsMessage<UsageError>(HasSubstr("option --width")))
        << text;
  }
}

TEST(MapLength, NeedsTheSnapshotsUnit) {
  SnapshotInfo silent = in_comoving_kpc();
  silent.types[0].fields[0].unit.clear();
  EXPECT_THAT([&] { length_of("4Mpc", silent); },
              ThrowsMessage<UsageError>(HasSubstr("set map.length_unit")));
  MapSettings says;
  says.length_unit = "kpc";
  EXPECT_NEAR(length_in_snapshot("4Mpc", says, silent, 0, "width"), 4000, 1e-9);
}

MapUnits units_of(double width, const MapSettings& settings = {}) {
  return decide_units(settings, in_comoving_kpc(), {0}, MapQuantity::Kind::counts, width);
}

TEST(MapAxes, AreInTheLargestUnitThatTheMapIsAsWideAs) {
  const double kpc = 0.7 / 0.5;  // in the snapshot's lengths
  EXPECT_EQ(units_of(10000 * kpc).length_name, "Mpc");
  EXPECT_NEAR(units_of(10000 * kpc).length_factor, 1e-3 / kpc, 1e-12);
  EXPECT_EQ(units_of(999 * kpc).length_name, "kpc");
  EXPECT_EQ(units_of(2e6 * kpc).length_name, "Gpc");
  EXPECT_EQ(units_of(0.5 * kpc).length_name, "pc");
}

TEST(MapAxes, AreInTheUnitThatIsAskedFor) {
  MapSettings settings;
  settings.axis_unit = "ly";
  EXPECT_EQ(units_of(10000, settings).length_name, "ly");
  settings.axis_unit = "Msun";
  EXPECT_THAT([&] { units_of(1, settings); },
              ThrowsMessage<UsageError>(HasSubstr("key map.axis_unit")));
}

}  // namespace
}  // namespace splotchcl
