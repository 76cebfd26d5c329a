// Pictures that are worked out at a few pixels and interpolated between them.
#include "surroundings/smooth_picture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

namespace splotchcl::test {
namespace {

SmoothPictureSettings settings_of(int width, int height, double allowed) {
  SmoothPictureSettings settings;
  settings.width = width;
  settings.height = height;
  settings.crop = {0, 0, width, height};
  settings.channels = 1;
  settings.allowed = allowed;
  settings.error_of = [](const double* exact, const double* foretold) {
    return std::abs(*exact - *foretold);
  };
  return settings;
}

// The second is far from all nodes that are 8 pixels apart, or 16.
struct Place {
  double x, y;
};
constexpr Place on_a_node = {80, 31.5}, between_nodes = {84.5, 36.5};

double gaussian(int x, int y, double sigma, Place place = on_a_node) {
  const double dx = (x - place.x) / sigma, dy = (y - place.y) / sigma;
  return std::exp(-dx * dx - dy * dy);
}

// Row by row.
std::vector<double> pixels_of(const SmoothPictureSettings& settings, const PixelFunction& pixel) {
  const SmoothPicture picture(settings, pixel);
  std::vector<double> pixels, row;
  for (int y = 0; y < settings.crop.height; ++y) {
    picture.row(y, row);
    pixels.insert(pixels.end(), row.begin(), row.end());
  }
  return pixels;
}

double largest_error(SmoothPictureSettings settings, double sigma, Place place) {
  settings.narrowest = sigma;
  const std::vector<double> pixels = pixels_of(
      settings,
      [sigma, place](int x, int y, int, double* value) { *value = gaussian(x, y, sigma, place); });
  double largest = 0;
  std::size_t i = 0;
  for (int y = settings.crop.y; y < settings.crop.y + settings.crop.height; ++y) {
    for (int x = settings.crop.x; x < settings.crop.x + settings.crop.width; ++x)
      largest = std::max(largest, std::abs(pixels[i++] - gaussian(x, y, sigma, place)));
  }
  return largest;
}

TEST(SmoothPicture, ErrsByNoMoreThanIsAllowed) {
  for (const double sigma : {1.0, 3.0, 10.0, 40.0, 300.0}) {
    for (const double allowed : {1e-3, 1e-6, 1e-9}) {
      for (const Place place : {on_a_node, between_nodes})
        EXPECT_LE(largest_error(settings_of(200, 120, allowed), sigma, place), allowed) << sigma;
    }
  }
}

TEST(SmoothPicture, WorksOutFewPixelsOfWhatIsSmooth) {
  std::atomic<int> count = 0;
  SmoothPictureSettings settings = settings_of(512, 512, 1e-5);
  settings.narrowest = 200;
  pixels_of(settings, [&count](int x, int y, int, double* value) {
    ++count;
    *value = gaussian(x, y, 200);
  });
  EXPECT_LT(count, 512 * 512 / 20);
}

TEST(SmoothPicture, OfACropHasTheBitsOfTheWholeOne) {
  SmoothPictureSettings settings = settings_of(200, 120, 1e-6);
  settings.narrowest = 30;
  const PixelFunction pixel = [](int x, int y, int, double* value) { *value = gaussian(x, y, 30); };
  const std::vector<double> whole = pixels_of(settings, pixel);
  settings.crop = {37, 11, 90, 70};
  const std::vector<double> crop = pixels_of(settings, pixel);
  for (std::size_t y = 0; y < 70; ++y) {
    for (std::size_t x = 0; x < 90; ++x)
      ASSERT_EQ(crop[y * 90 + x], whole[(y + 11) * 200 + x + 37]);
  }
}

TEST(SmoothPicture, InSinglePrecisionRoundsOffNoMoreThanItSays) {
  SmoothPictureSettings settings = settings_of(200, 120, 1e-3);
  settings.narrowest = 40;
  const SmoothPicture picture(
      settings, [](int x, int y, int, double* value) { *value = 1000 * gaussian(x, y, 40) + 1; });
  std::vector<double> exact;
  std::vector<float> rounded;
  double largest_error = 0;
  for (int y = 0; y < 120; ++y) {
    picture.row(y, exact);
    picture.row(y, rounded);
    for (std::size_t x = 0; x < 200; ++x)
      largest_error = std::max(largest_error, std::abs(static_cast<double>(rounded[x]) - exact[x]));
  }
  EXPECT_GE(picture.largest(), 1000);
  EXPECT_LE(largest_error, SmoothPicture::single_rounding * picture.largest());
  EXPECT_GT(largest_error, 0);
}

}  // namespace
}  // namespace splotchcl::test
