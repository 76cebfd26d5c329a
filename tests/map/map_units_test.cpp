#include "map/map_units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/gas.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using test::Gas;
using test::map_of;
using test::map_scene;
using testing::HasSubstr;

Gas wide_particle() {
  return test::one_particle({{0, 0, 0}}, 10, 3);
}

std::string refusal(const Scene& scene) {
  try {
    map_of(scene, wide_particle().snapshot());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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

}  // namespace
}  // namespace splotchcl
