#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "map/gas.h"
#include "paths.h"
#include "splotchcl/snapshot_file.h"

// Mean surface densities and temperatures of real files, against numbers worked out by hand.
namespace splotchcl {
namespace {

using test::map_of;

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
}  // namespace splotchcl
