#include "map/map_units.h"

#include "formats/hdf5/hdf5_values.h"
#include "map/gas.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Gas wide_particle() {
  return test::one_particle({{0, 0, 0}}, 10, 3);
}

std::string refusal(const Scene& scene) {
  return refusal_by<Error>([&] { map_of(scene, wide_particle().snapshot()); });
}

TEST(MapUnits, AreThoseThatTheSettingsSay) {
  Scene scene = map_scene();
  const double in_code =
      static_cast<double>(test::at(map_of(scene, wide_particle().snapshot()), 32, 24));
  scene.map.length_unit = "kpc";
  scene.map.mass_unit = "1e10 Msun";
  scene.map.unit = "Msun/pc^2";
  const Map map = map_of(scene, wide_particle().snapshot());
  EXPECT_EQ(map.unit, "Msun/pc^2");
  EXPECT_EQ(map.length_unit, "kpc");
  EXPECT_NEAR(static_cast<double>(test::at(map, 32, 24)) / in_code, 1e10 / 1e6, 1e-2);
}

TEST(MapUnits, OfAFormulaFollowFromItsFields) {
  Scene scene = map_scene();
  scene.map.quantity = "smoothing_length^2 * mass";
  scene.map.length_unit = "kpc";
  scene.map.mass_unit = "Msun";
  EXPECT_EQ(map_of(scene, wide_particle().snapshot()).unit, "kpc^2 Msun");
  scene.map.unit = "Msun pc^2";
  const Map map = map_of(scene, wide_particle().snapshot());
  EXPECT_NEAR(static_cast<double>(test::at(map, 32, 24)), 300e6, 1e3);
  scene.map.quantity = "log10(mass)";
  EXPECT_THAT(refusal(scene), HasSubstr("the map is in no_unit"));
  scene.map.quantity = "smoothing_length + mass";
  scene.map.unit = "";
  EXPECT_THAT(refusal(scene), HasSubstr("smoothing_length in kpc beside mass in Msun"));
}

TEST(MapUnits, OfAFieldAreConverted) {
  Gas gas = wide_particle();
  auto snapshot = gas.snapshot();
  Scene scene = map_scene();
  scene.map.quantity = "smoothing_length";
  scene.map.length_unit = "kpc";
  scene.map.unit = "pc";
  EXPECT_NEAR(static_cast<double>(test::at(map_of(scene, snapshot), 32, 24)), 10000, 0.1);
}

// A thousandth of the density is the same in units a thousand times as large.
TEST(MapUnits, OfDensitiesNeedNotBeThoseOfMassesAndPositions) {
  Gas gas = wide_particle();
  auto plain = gas.snapshot(), scaled = gas.snapshot();
  for (auto* const snapshot : {&plain, &scaled}) {
    snapshot->set_unit(0, "mass", "Msun");
    snapshot->set_unit(0, "position", "kpc");
  }
  plain.set_unit(0, "density", "Msun/kpc^3");
  scaled.set_unit(0, "density", "1e3 Msun/kpc^3");
  Scene scene = map_scene();
  scene.map.quantity = "temperature";
  scene.map.statistic = MapStatistic::integral;
  const Map map = map_of(scene, plain), other = map_of(scene, scaled);
  EXPECT_NEAR(static_cast<double>(test::at(map, 32, 24) / test::at(other, 32, 24)), 1e3, 1e-2);
  scaled.set_unit(0, "density", "K");
  EXPECT_THROW(map_of(scene, scaled), UsageError);
}

TEST(MapUnits, AreNeverGuessed) {
  Scene scene = map_scene();
  scene.map.unit = "Msun/pc^2";
  EXPECT_THAT(refusal(scene), HasSubstr("code_mass/code_length^2"));
}

// Of a map in Msun/pc^2 of masses and positions in these units.
std::string refusal_of(const char* mass, const char* position) {
  test::MemorySnapshot snapshot = wide_particle().snapshot();
  snapshot.set_unit(0, "mass", mass);
  snapshot.set_unit(0, "position", position);
  Scene scene = map_scene();
  scene.map.unit = "Msun/pc^2";
  return refusal_by<Error>([&] { map_of(scene, snapshot); });
}

TEST(MapUnits, ThatAreNotKnownAreToldFromThoseThatAreNotSaid) {
  EXPECT_THAT(refusal_of("Msun", "furlong"),
              HasSubstr("in Msun/furlong^2, since the snapshot does not say units that are known"));
}

TEST(MapUnits, ThatLackTheSnapshotsFactorsSayWhich) {
  EXPECT_THAT(refusal_of("Msun/h", "a kpc/h"), HasSubstr("does not say the numbers for a and h"));
}

TEST(MapUnits, ThatDoNotExistAreToldBeforeUnitsThatAreMissing) {
  Scene scene = map_scene();
  scene.map.unit = "furlong";
  EXPECT_THAT(refusal(scene), HasSubstr("found 'furlong'"));
}

TEST(MapUnits, OfADensityNeedBothUnitsOfTheFile) {
  ParticleTypeInfo type;
  type.fields = {{"position", "Coordinates", 3, "kpc"}, {"mass", "Masses", 1, "g"}};
  EXPECT_EQ(name_of_density(type), "g/kpc^3");
  type.fields.back().unit.clear();
  EXPECT_EQ(name_of_density(type), "");
}

TEST(MapUnits, RefuseAnotherDimension) {
  Scene scene = map_scene();
  scene.map.length_unit = "kpc";
  scene.map.mass_unit = "1e10 Msun";
  scene.map.unit = "K";
  EXPECT_THAT(refusal(scene), HasSubstr("same dimension"));
}

TEST(MapUnits, OfTheSettingsHaveTheirDimensionAndASize) {
  const auto refusal_of = [](std::string MapSettings::*setting, const char* unit) {
    Scene scene = map_scene();
    scene.map.*setting = unit;
    return refusal(scene);
  };
  EXPECT_THAT(refusal_of(&MapSettings::length_unit, "K"), HasSubstr("expected a length above 0"));
  EXPECT_THAT(refusal_of(&MapSettings::mass_unit, "km"), HasSubstr("expected a mass above 0"));
  EXPECT_THAT(refusal_of(&MapSettings::mass_unit, "0 g"), HasSubstr("expected a mass above 0"));
  EXPECT_THAT(refusal_of(&MapSettings::velocity_unit, "kpc"),
              HasSubstr("expected a velocity above 0"));
  EXPECT_THAT(refusal_of(&MapSettings::unit, "0 g"), HasSubstr("expected a unit above 0"));
}

// The largest float is 3.4e38.
TEST(MapUnits, RefuseValuesThatNoFloatHolds) {
  Scene scene = map_scene();
  scene.map.quantity = "mass";
  scene.map.mass_unit = "1e10 Msun";
  scene.map.unit = "g";
  EXPECT_THAT(refusal(scene), HasSubstr("largest value is 5.97e+43"));
}

TEST(MapUnits, OfProductsAreWrittenFactorByFactor) {
  Scene scene = map_scene();
  scene.map.mass_unit = "1e10 Msun";
  scene.map.length_unit = "Mpc/pc kpc";
  EXPECT_EQ(map_of(scene, wide_particle().snapshot()).unit, "1e10 Msun Mpc^-2 pc^2 kpc^-2");
}

// A kiloparsec at a megaparsec is seen under 3.4 arc minutes.
TEST(MapUnits, OfProductsOfPowersAreWrittenFactorByFactor) {
  Scene scene = map_scene();
  scene.map.mass_unit = "1e10 Msun";
  scene.map.length_unit = "Mpc^1.5 kpc^1.5/pc^2";
  EXPECT_EQ(map_of(scene, wide_particle().snapshot()).unit, "1e10 Msun Mpc^-3 kpc^-3 pc^4");
  scene.map.length_unit = "3 kpc";
  EXPECT_EQ(map_of(scene, wide_particle().snapshot()).unit, "1e10 Msun (3 kpc)^-2");
}

TEST(MapUnits, OfTheSkyFollowFromTheDistance) {
  Scene scene = map_scene();
  scene.map.length_unit = "kpc";
  scene.map.distance = "1 Mpc";
  scene.map.sky = {10, -20};
  const Map map = map_of(scene, wide_particle().snapshot());
  ASSERT_TRUE(map.sky);
  EXPECT_NEAR(map.sky->pixel, 1e-3 * 180 / std::acos(-1.0), 1e-12);
  EXPECT_EQ(map.sky->declination, -20);
}

// Matter alone at redshift 3: 2 c / H0 (1 - 1 / sqrt(4)) / 4 = 1070.687 Mpc for h = 0.7.
TEST(MapUnits, OfTheSkyFollowFromTheRedshiftToo) {
  test::MemorySnapshot snapshot = wide_particle().snapshot();
  Cosmology cosmology;
  cosmology.scale_factor = 0.25;
  cosmology.omega_matter = 1;
  snapshot.set_cosmology(cosmology);
  snapshot.set_hubble_parameter(0.7);
  Scene scene = map_scene();
  scene.map.length_unit = "kpc";
  scene.map.distance = "redshift";
  const Map map = map_of(scene, snapshot);
  ASSERT_TRUE(map.sky);
  EXPECT_NEAR(map.sky->pixel * std::acos(-1.0) / 180 * 1070.687e3, 1, 1e-6);
}

TEST(MapUnits, RefuseTheSkyWhereLengthsAreNotKnown) {
  Scene scene = map_scene();
  scene.map.distance = "1 Mpc";
  EXPECT_THAT(refusal(scene), HasSubstr("set map.length_unit"));
  scene.map.length_unit = "kpc";
  scene.map.distance = "3 K";
  EXPECT_THAT(refusal(scene), HasSubstr("expected a length"));
}

TEST(MapUnits, RefuseTypesInSeveralUnits) {
  const auto refusal_of = [](const char* unit) {
    test::MemorySnapshot snapshot = wide_particle().snapshot();
    snapshot.add(4, "position", {1, 2, 3}, 3);
    snapshot.add(4, "smoothing_length", {1});
    snapshot.add(4, "mass", {1});
    snapshot.set_unit(0, "mass", "Msun");
    snapshot.set_unit(4, "mass", unit);
    Scene scene = map_scene();
    scene.components.front().types = {0, 4};
    try {
      map_of(scene, snapshot);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal_of("M_sun"), "");
  EXPECT_EQ(refusal_of(""), "");
  EXPECT_THAT(refusal_of("g"), HasSubstr("whose mass is in \"Msun\" and in \"g\""));
}

TEST(MapUnits, RefuseAUnitForCounts) {
  Scene scene = map_scene();
  scene.map.quantity = "counts";
  scene.map.unit = "K";
  EXPECT_THAT(refusal(scene), HasSubstr("no unit for counts"));
}

// Maps of files with the header that GIZMO writes, against numbers worked out by hand.

// One particle of mass 2, velocity 3 and internal energy 1e8, in the middle of a pixel.
class MapUnitsOfGizmo : public ::testing::Test {
 protected:
  void write(const std::vector<std::pair<std::string, double>>& header) const {
    const Hdf5Output file = test::create_hdf5(path_);
    test::make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {1, 0, 0, 0, 0, 0});
    write_attribute(file, "Header", "GIZMO_version", {2022});
    for (const auto& [name, value] : header)
      write_attribute(file, "Header", name, {value});
    write_values(file, "PartType0/Coordinates", {0, 0, 0}, 3);
    write_values(file, "PartType0/Velocities", {0, 0, -3}, 3);
    write_values(file, "PartType0/Masses", {2});
    write_values(file, "PartType0/SmoothingLength", {0.01});
    write_values(file, "PartType0/InternalEnergy", {1e8});
  }
  double map(const std::string& quantity, const std::string& unit) const {
    Scene scene = test::map_scene();
    scene.image.width = scene.image.height = 1;
    scene.map.width = 1;
    scene.map.quantity = quantity;
    scene.map.unit = unit;
    return static_cast<double>(test::map_of(scene, *open_snapshot(path_)).values[0]);
  }
  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "snapshot_000.hdf5";
};

// A column of 2e10 Msun/h in (0.5 kpc/h)^2 at h = 0.7 is 2e10 * 0.7 / 0.25 Msun/kpc^2, and GIZMO
// writes velocities over the root of the scale factor.
TEST_F(MapUnitsOfGizmo, InABoxAreComovingAndHaveTheHubbleParameter) {
  write({{"ComovingIntegrationOn", 1},
         {"Time", 0.5},
         {"Redshift", 1},
         {"Omega_Matter", 0.3},
         {"Omega_Lambda", 0.7},
         {"HubbleParam", 0.7},
         {"UnitLength_In_CGS", 3.0856775814913673e21 / 0.7},
         {"UnitMass_In_CGS", 1.988409870698051e43 / 0.7},
         {"UnitVelocity_In_CGS", 1e5}});
  EXPECT_NEAR(map("surface_density", "Msun/kpc^2") / 5.6e10, 1, 1e-6);
  EXPECT_NEAR(map("line_of_sight_velocity", "km/s"), 3 * std::sqrt(0.5), 1e-6);
}

// pc, Msun and m/s: 2 Msun/pc^2 = 2 * 1.98841e33 / (3.08568e18)^2 g/cm^2. 1e8 (m/s)^2 are
// 1e12 (cm/s)^2, and ionized gas has mu = 4 / (8 - 5 * 0.24) = 0.588: T = 2/3 1e12 mu m_p / k_B.
TEST_F(MapUnitsOfGizmo, OfACloudAreTheHeaders) {
  write({{"ComovingIntegrationOn", 0},
         {"Time", 0.01},
         {"Redshift", 0},
         {"HubbleParam", 1},
         {"UnitLength_In_CGS", 3.085678e18},
         {"UnitMass_In_CGS", 1.989e33},
         {"UnitVelocity_In_CGS", 100}});
  EXPECT_NEAR(map("surface_density", "g/cm^2") / 4.1767147e-4, 1, 2e-6);
  EXPECT_NEAR(map("line_of_sight_velocity", "km/s"), 0.003, 1e-8);
  EXPECT_NEAR(map("temperature", "K") / 4750.883, 1, 2e-6);
}

// Mean surface densities and temperatures of real files, against numbers worked out by hand.

Scene scene_of_gas() {
  Scene scene = test::map_scene();
  scene.image.width = scene.image.height = 24;
  scene.tolerance = 1e-3;
  scene.map.center.reset();
  scene.map.width.reset();
  return scene;
}

double mean_of(const Scene& scene, const std::string& file) {
  const Map map = map_of(scene, *open_snapshot(test::data_folder() / file));
  return std::accumulate(map.values.begin(), map.values.end(), 0.0) /
         static_cast<double>(map.values.size());
}

#define SKIP_WITHOUT(file)                                            \
  if (!std::filesystem::exists(test::data_folder() / (file))) {       \
    GTEST_SKIP() << "no " << (file) << " in " << test::data_folder(); \
  }                                                                   \
  static_assert(true)

// 32768 particles of 4.2350764e10 Msun/h in (50000 kpc/h)^2 at a = 0.7 and h = 0.7, so in
// (50000 kpc)^2: 1.9825014e15 Msun / 2.5e15 pc^2.
TEST(MapUnitsOfRealFiles, OfGadgetAreWhatTheUserSays) {
  SKIP_WITHOUT("lcdm/fmt2_snapshot_005");
  Scene scene = scene_of_gas();
  scene.map.length_unit = "a kpc/h";
  scene.map.mass_unit = "1e10 Msun/h";
  scene.map.unit = "Msun/pc^2";
  EXPECT_NEAR(mean_of(scene, "lcdm/fmt2_snapshot_005") / 0.79300058, 1, 1e-4);
}

// 32768 particles of 6.05011e10 Msun in (71.428571 Mpc a)^2 at a = 0.98, so in (70 Mpc)^2:
// 1.9825e15 Msun / 4.9e15 pc^2; a solar mass per square parsec is 2.08842e-4 g/cm^2.
TEST(MapUnitsOfRealFiles, OfSwiftAreTheFiles) {
  SKIP_WITHOUT("swift/swift_lcdm_0000.hdf5");
  Scene scene = scene_of_gas();
  scene.map.unit = "Msun/pc^2";
  EXPECT_NEAR(mean_of(scene, "swift/swift_lcdm_0000.hdf5") / 0.40459180, 1, 1e-4);
  scene.map.unit = "g/cm^2";
  EXPECT_NEAR(mean_of(scene, "swift/swift_lcdm_0000.hdf5") / (0.40459180 * 2.08842e-4), 1, 1e-4);
}

// 1000 particles of 5.05e-5 Msun and a file in au; all of them, whatever their lengths.
TEST(MapUnitsOfRealFiles, OfPhantomAreTheFiles) {
  const std::string file = "phantom/dustmixture_00000.h5";
  SKIP_WITHOUT(file);
  Scene scene = scene_of_gas();
  scene.map.width = 10000;
  scene.map.unit = "g/cm^2";
  const double area = std::pow(10000 * 1.495978707e13, 2);
  EXPECT_NEAR(mean_of(scene, file) * area / (1000 * 5.05e-5 * 1.98841e33), 1, 1e-4);
}

// 20000 particles of 2.3251971288e6 Msun in (1000 kpc)^2.
TEST(MapUnitsOfRealFiles, OfGadgetFourAreTheFiles) {
  const std::string file = "galaxy_collision/snapshot_000.hdf5";
  SKIP_WITHOUT(file);
  Scene scene = scene_of_gas();
  scene.components.front().types = {2};
  scene.map.width = 1000;
  scene.map.unit = "Msun/pc^2";
  EXPECT_NEAR(mean_of(scene, file) / (20000 * 2.3251971288e6 / 1e12), 1, 1e-4);
}

}  // namespace
}  // namespace splotchcl::test
