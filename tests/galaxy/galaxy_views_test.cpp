// The galaxy from other sides than that of its picture, and from close by.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "galaxy/galaxy_frame.h"
#include "galaxy/galaxy_picture.h"

namespace splotchcl::test {
namespace {

double brightness(const Image& image, int x, int y) {
  const float* const pixel = image.at(x, y);
  return static_cast<double>(pixel[0] + pixel[1] + pixel[2]) / 3;
}

// How rough a picture is where it should be smooth: the root mean square of a pixel's light
// relative to the mean of the square around it, away from the borders.
double roughness(const Image& image, int reach) {
  double sum = 0;
  int count = 0;
  for (int y = reach; y < image.height - reach; ++y) {
    for (int x = reach; x < image.width - reach; ++x) {
      double around = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx)
          around += brightness(image, x + dx, y + dy);
      }
      around /= (2 * reach + 1) * (2 * reach + 1);
      sum += std::pow(brightness(image, x, y) / around - 1, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

Galaxy spiral(double dust = 1) {
  GalaxySettings settings = small_settings();
  settings.clusters = 0;  // points of light
  settings.dust = dust;
  return make_galaxy(SpiralPicture().draw(), settings);
}

// From far away in this direction, with the disk's axis upwards, 16 kpc across.
Frame seen_from(const Galaxy& galaxy, const Vec3& direction) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.position = direction * 100.0;
  camera.look_at = {{0, 0, 0}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = 2 * std::atan(16 / 200.0) * 180 / M_PI;
  return galaxy_frame(galaxy, camera, 320, 160);
}

// Mean light of a row's middle half.
double row_brightness(const Image& image, int y) {
  double sum = 0;
  for (int x = image.width / 4; x < 3 * image.width / 4; ++x)
    sum += brightness(image, x, y);
  return sum / (image.width / 2);
}

// 0.122 where points were at random, with lengths to neighbour 24.
TEST(GalaxyViews, CloseUpIsSmoothWhereThePictureIs) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const DiskPicture picture = {320, 320, 160, 160, 40};
  GalaxySettings settings;
  settings.size_kpc = 16;
  settings.clusters = 0;  // points of light
  Camera camera;
  camera.position = {{3, -2.5, 1.5}};
  camera.look_at = {{3, -1, 0}};
  camera.sky = {{0, 0, 1}};
  camera.field_of_view_degrees = 40;
  const auto found = [&] {
    const Galaxy galaxy = make_galaxy(picture.draw(), settings);
    return roughness(Renderer().render(galaxy_frame(galaxy, camera, 240, 135)), 12);
  };
  const double usual = found();
  EXPECT_LT(usual, 0.122 / 3);
  settings.detail = 4;
  EXPECT_LT(found(), 0.75 * usual);
}

TEST(GalaxyViews, ALaneDarkensTheMiddleOfAnEdge) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const Image edge = Renderer().render(seen_from(spiral(), {{0, -1, 0}}));
  const double pixel = 16.0 / 320;  // kpc
  const double middle = row_brightness(edge, 80);
  const int aside = static_cast<int>(0.2 / pixel);
  EXPECT_LT(middle, 0.4 * row_brightness(edge, 80 - aside));
  EXPECT_LT(middle, 0.4 * row_brightness(edge, 80 + aside));
  const Image bare = Renderer().render(seen_from(spiral(0), {{0, -1, 0}}));
  EXPECT_GT(row_brightness(bare, 80), row_brightness(bare, 80 + aside));
}

// The bulge of a tilted galaxy, a ball of stars, is darker below its middle, where the disk that
// lies in front has dust; without dust it is the same above and below.
TEST(GalaxyViews, TheNearSideOfATiltedDiskLiesInShadow) {
  if (list_devices().empty()) GTEST_SKIP() << "no OpenCL device here";
  const auto near_over_far = [](const Galaxy& galaxy) {
    const double tilt = 15 * M_PI / 180;
    Frame frame = seen_from(galaxy, {{0, -std::cos(tilt), std::sin(tilt)}});
    // Of the light, the bulge's alone.
    frame.components = {frame.components[2], frame.components[4]};
    const Image image = Renderer().render(frame);
    double near = 0, far = 0;
    for (int row = 3; row < 11; ++row) {
      near += row_brightness(image, 80 + row);
      far += row_brightness(image, 79 - row);
    }
    return near / far;
  };
  EXPECT_LT(near_over_far(spiral()), 0.8);
  EXPECT_NEAR(near_over_far(spiral(0)), 1, 0.05);
}

}  // namespace
}  // namespace splotchcl::test
