#include <fitsio.h>

#include "map/gas.h"
#include "scene/constants.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

double mass_of(const Gas& gas) {
  double mass = 0;
  for (const float m : gas.mass)
    mass += static_cast<double>(m);
  return mass;
}

TEST(MapShapes, OfASphereHaveAllOfTheMass) {
  const Gas gas = random_gas(60, 30, 0.01F, 60);
  Scene scene = map_scene();
  scene.tolerance = 1e-3;
  scene.map.healpix = 8;
  const Map map = map_of(scene, gas.snapshot());
  EXPECT_EQ(map.shape, MapShape::healpix);
  EXPECT_EQ(map.unit, "code_mass/sr");
  ASSERT_EQ(map.values.size(), 768U);
  EXPECT_NEAR(total_of(map.values) * 4 * pi / 768, mass_of(gas), 1e-6 * mass_of(gas));
}

TEST(MapShapes, OfASkyAreSeenFromTheCenter) {
  Scene scene = map_scene();
  scene.map.view = MapView::sky;
  scene.map.width = 60;
  scene.map.sky = {90, 0};
  // A little to the left of y and above, where longitudes and latitudes are larger.
  const Map map = map_of(scene, one_particle({{-1, 10, 1}}, 0.1F).snapshot());
  const auto brightest =
      static_cast<int>(std::max_element(map.values.begin(), map.values.end()) - map.values.begin());
  EXPECT_LT(brightest % map.width, map.width / 2);
  EXPECT_LT(brightest / map.width, map.height / 2);
  EXPECT_EQ(map.sky->projection, "TAN");
}

TEST(MapShapes, OfVoxelsHaveADensity) {
  Scene scene = map_scene();
  scene.map.voxels = {3, 5, 7};
  scene.map.width = 3;
  const Map map = map_of(scene, one_particle({{0, 1, -2}}, 0.5F, 2).snapshot());
  ASSERT_EQ(map.values.size(), 3U * 5U * 7U);
  EXPECT_EQ(map.planes(), 7);
  const double along = std::erf(0.5 / (0.5 * sigma_of_h));
  // z = -2 is the second plane, y = 1 the second row from the top.
  EXPECT_NEAR(static_cast<double>(map.values[(1 * 5 + 1) * 3 + 1]), 2 * std::pow(along, 3), 1e-6);
  EXPECT_NEAR(total_of(map.values), 2, 1e-6);
}

TEST(MapShapes, OfShellsHaveAllOfTheParticles) {
  Scene scene = map_scene();
  scene.map.quantity = "counts";
  scene.map.profile = 10;
  scene.map.shell = {{1e-6, 1e3}};
  const Map map = map_of(scene, random_gas(50, 30, 0.01F, 60).snapshot());
  EXPECT_NEAR(total_of(map.values), 50, 1e-4);
  EXPECT_DOUBLE_EQ(map.axes.front().edge(10), 1e3);
}

TEST(MapShapes, OfTwoFieldsHaveEachParticleInOneBin) {
  Scene scene = map_scene();
  scene.map.quantity = "counts";
  scene.map.histogram = {"density", "temperature"};
  scene.map.bins = {4, 6};
  const Map map = map_of(scene, random_gas(50, 30, 1, 2).snapshot());
  EXPECT_EQ(map.width, 4);
  EXPECT_EQ(map.height, 6);
  EXPECT_EQ(total_of(map.values), 50);
  EXPECT_TRUE(map.axes[1].is_logarithmic);
}

TEST(MapShapes, AreOneAtATime) {
  Scene scene = map_scene();
  scene.map.healpix = 4;
  scene.map.profile = 4;
  EXPECT_THAT(
      [&] {
        map_of(scene, one_particle({{0, 0, 1}}).snapshot());
      },
      ThrowsMessage<UsageError>(HasSubstr("found both")));
}

TEST(MapShapes, OfASphereAreATableInFits) {
  const test::TemporaryFolder folder;
  Scene scene = map_scene();
  scene.map.healpix = 16;
  scene.map.healpix_order = HealpixOrder::nested;
  const auto snapshot = one_particle({{0, 0, 1}}).snapshot();
  const Map map = map_of(scene, snapshot);
  const std::filesystem::path path = folder.path() / "sky.fits";
  write_map(path, map, scene, snapshot.info(), {});
  fitsfile* file = nullptr;
  int status = 0;
  fits_open_table(&file, path.c_str(), READONLY, &status);
  char text[FLEN_VALUE];
  fits_read_key(file, TSTRING, "ORDERING", text, nullptr, &status);
  long nside = 0;
  fits_read_key(file, TLONG, "NSIDE", &nside, nullptr, &status);
  std::vector<float> values(map.values.size());
  fits_read_col(file, TFLOAT, 1, 1, 1, static_cast<LONGLONG>(values.size()), nullptr, values.data(),
                nullptr, &status);
  fits_close_file(file, &status);
  EXPECT_EQ(status, 0);
  EXPECT_STREQ(text, "NESTED");
  EXPECT_EQ(nside, 16);
  EXPECT_EQ(values, map.values);
}

TEST(MapShapes, OfAProfileAreATextWithAHeader) {
  const test::TemporaryFolder folder;
  Scene scene = map_scene();
  scene.map.profile = 2;
  scene.map.shell = {{1, 4}};
  const auto snapshot = one_particle({{0, 0, 1}}).snapshot();
  const std::filesystem::path path = folder.path() / "p.csv";
  write_map(path, map_of(scene, snapshot), scene, snapshot.info(), {});
  std::ifstream file(path);
  std::string header, first;
  std::getline(file, header);
  std::getline(file, first);
  EXPECT_EQ(header, "inner [code_length],outer [code_length],density [code_mass/code_length^3]");
  EXPECT_EQ(first.rfind("1,2,", 0), 0U);
}

TEST(MapShapes, TakeLengthsWithUnits) {
  Scene scene = map_scene();
  scene.map.length_unit = "kpc";
  scene.map.lengths_with_units = {{"width", "64kpc"}};
  scene.map.width.reset();
  const Map map = map_of(scene, one_particle({{0, 0, 1}}).snapshot());
  EXPECT_DOUBLE_EQ(map.pixel, 1);
  EXPECT_EQ(map.length_unit, "kpc");
}

}  // namespace
}  // namespace splotchcl::test
