// What the dust of a galaxy absorbs, and where it lies.
#include <gtest/gtest.h>

#include <cmath>

#include "galaxy/dust_map.h"
#include "galaxy/galaxy_frame.h"
#include "galaxy/galaxy_picture.h"

namespace splotchcl::test {
namespace {

GalaxySettings spiral_settings() {
  GalaxySettings settings = small_settings();
  settings.removes_stars = false;
  settings.center = {120, 120};
  return settings;
}

TEST(Dust, ASheetHidesHalfOfTheLightAtMost) {
  const Veil sheet(0, 1);
  EXPECT_DOUBLE_EQ(sheet.transmission(0), 1);
  for (const double depth : {0.5, 2.0, 10.0, 40.0})
    EXPECT_NEAR(sheet.transmission(depth), (1 + std::exp(-depth)) / 2, 1e-4);
}

// Mixed evenly with the stars: the mean of exp(-t) for t from 0 to the depth.
TEST(Dust, DustAmongTheStarsHidesMore) {
  const Veil mixed(1, 1);
  for (const double depth : {0.5, 2.0, 10.0})
    EXPECT_NEAR(mixed.transmission(depth) / (-std::expm1(-depth) / depth), 1, 0.005);
}

TEST(Dust, DepthIsTheInverseOfTransmission) {
  const Veil veil(0.05, 0.12);
  for (const double depth : {0.0, 0.3, 1.234, 2.4})
    EXPECT_NEAR(veil.depth(veil.transmission(depth), 3), depth, 1e-6);
  EXPECT_EQ(veil.depth(0.1, 2.5), 2.5);
}

TEST(Dust, LiesWhereThePictureHasDarkLanes) {
  const SpiralPicture picture;
  const Galaxy galaxy = make_galaxy(picture.draw(), spiral_settings());
  double in_lanes = 0, elsewhere = 0;
  int lanes = 0, others = 0;
  for (std::size_t i = 0; i < galaxy.dust.count(); ++i) {
    const int x = static_cast<int>(
        std::floor(static_cast<double>(galaxy.dust.position[3 * i]) / (16.0 / 240) + 120));
    const int y = static_cast<int>(
        std::floor(120 - static_cast<double>(galaxy.dust.position[3 * i + 1]) / (16.0 / 240)));
    const double radius = std::hypot(x - 120, y - 120);
    if (radius < 25 || radius > 75) continue;
    // Dust particles stand for equal areas.
    (picture.is_lane(x, y) ? in_lanes : elsewhere) += static_cast<double>(galaxy.dust.mass[i]);
    ++(picture.is_lane(x, y) ? lanes : others);
  }
  ASSERT_GT(lanes, 1000);
  EXPECT_GT(in_lanes / lanes, 1.7 * elsewhere / others);
}

// In front of white light, seen face-on.
TEST(Dust, ReddensWhatItDims) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const Galaxy galaxy = make_galaxy(SpiralPicture().draw(), spiral_settings());
  Camera camera;
  camera.position = {{0, 0, 40}};
  camera.look_at = {{0, 0, 0}};
  camera.field_of_view_degrees = 20;
  Frame frame = galaxy_frame(galaxy, camera, 100, 100);
  frame.components = {drawn_dust(galaxy.dust)};
  frame.background = {{1, 1, 1}};
  const Image veiled = Renderer().render(frame);
  int dark = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const float* const pixel = veiled.at(x, y);
      const double red = -std::log(pixel[0]), green = -std::log(pixel[1]),
                   blue = -std::log(pixel[2]);
      if (green < 0.5) continue;
      ++dark;
      // The tolerance is 0.001 of light that is 0.05 at least.
      ASSERT_NEAR(red / green, 0.57, 0.03);
      ASSERT_NEAR(blue / green, 1.33, 0.03);
    }
  }
  EXPECT_GT(dark, 200);
}

TEST(Dust, NoneIsMadeWhereNoneIsWanted) {
  GalaxySettings settings = small_settings();
  settings.dust = 0;
  EXPECT_EQ(make_galaxy(SpiralPicture().draw(), settings).dust.count(), 0u);
}

}  // namespace
}  // namespace splotchcl::test
