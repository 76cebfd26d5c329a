// How 8 bits are rounded so that faint light has no steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/blue_noise.h"
#include "image/void_and_cluster.h"
#include "splotchcl/image_file.h"

namespace splotchcl {
namespace {

constexpr int side = 64;  // of the tile

ImageFileOptions dithered() {
  ImageFileOptions options;
  options.dithers = true;
  return options;
}

Image even(int width, int height, float light) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), light);
  return image;
}

double mean(const std::vector<std::uint8_t>& bytes) {
  double sum = 0;
  for (const std::uint8_t byte : bytes)
    sum += byte;
  return sum / static_cast<double>(bytes.size());
}

TEST(BlueNoise, IsThatOfVoidsAndClusters) {
  const std::vector<std::uint16_t> found = test::VoidAndCluster(side).ranks();
  EXPECT_TRUE(std::equal(found.begin(), found.end(), blue_noise_ranks.begin()));
}

TEST(BlueNoise, HasEachRankOnce) {
  auto ranks = blue_noise_ranks;
  std::sort(ranks.begin(), ranks.end());
  for (std::size_t i = 0; i < ranks.size(); ++i)
    EXPECT_EQ(ranks[i], i);
}

// White noise would have neighbours as like as any two places: sqrt(1/6) = 0.41 of all ranks.
TEST(BlueNoise, HasNeighboursThatDiffer) {
  double squares = 0;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const double here = blue_noise_ranks[side * y + x];
      const double right = blue_noise_ranks[side * y + (x + 1) % side];
      squares += (here - right) * (here - right);
    }
  }
  EXPECT_GT(std::sqrt(squares / (side * side)) / (side * side), 0.45);
}

// Ranks are 4096 steps: a mean is at most half of one off, and floats add a little.
TEST(Dither, HasMeanZeroOverATile) {
  for (const double value : {0.1, 7.3, 100.01, 128.5, 254.9}) {
    const Image image = even(side, side, static_cast<float>(value / 255));
    EXPECT_NEAR(mean(display_bytes("a", image, dithered())), value, 0.5 / 4096 + 3e-5) << value;
  }
}

TEST(Dither, IsOffByLessThanOneStep) {
  Image image(256, 16);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i) / static_cast<float>(image.pixels.size());
  const std::vector<std::uint8_t> bytes = display_bytes("a", image, dithered());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_LT(std::abs(bytes[i] - 255 * image.pixels[i / 3 * 4 + i % 3]), 1) << i;
}

TEST(Dither, KeepsWhatEightBitsHold) {
  for (int byte = 0; byte < 256; ++byte) {
    const Image image = even(side, side, static_cast<float>(byte) / 255);
    const std::vector<std::uint8_t> bytes = display_bytes("a", image, dithered());
    EXPECT_EQ(*std::min_element(bytes.begin(), bytes.end()), byte);
    EXPECT_EQ(*std::max_element(bytes.begin(), bytes.end()), byte);
  }
}

TEST(Dither, KeepsGrayGray) {
  const std::vector<std::uint8_t> bytes = display_bytes("a", even(9, 9, 0.2F), dithered());
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    EXPECT_EQ(bytes[i], bytes[i + 1]);
    EXPECT_EQ(bytes[i], bytes[i + 2]);
  }
}

TEST(Dither, HasTheSameBitsEachTime) {
  const Image image = even(70, 130, 0.123F);
  EXPECT_EQ(display_bytes("a", image, dithered()), display_bytes("b", image, dithered()));
}

TEST(Dither, HasTheWholePicturesBitsInACrop) {
  const std::vector<std::uint8_t> whole = display_bytes("a", even(100, 90, 0.123F), dithered());
  ImageFileOptions options = dithered();
  options.places = {31, 77, 20, 13};
  const std::vector<std::uint8_t> part = display_bytes("a", even(20, 13, 0.123F), options);
  for (std::size_t y = 0; y < 13; ++y) {
    for (std::size_t x = 0; x < 60; ++x)
      EXPECT_EQ(part[60 * y + x], whole[300 * (y + 77) + 3 * 31 + x]);
  }
}

TEST(Dither, IsTheSameInViewsBesideEachOther) {
  ImageFileOptions options = dithered();
  options.places = {0, 0, 30, 20};
  const std::vector<std::uint8_t> pair = display_bytes("a", even(60, 20, 0.123F), options);
  for (std::size_t y = 0; y < 20; ++y) {
    for (std::size_t x = 0; x < 90; ++x)
      EXPECT_EQ(pair[180 * y + x], pair[180 * y + 90 + x]);
  }
}

TEST(Dither, LeavesTruncatedBitsAlone) {
  ImageFileOptions options;
  options.truncates = true;
  const std::vector<std::uint8_t> plain = display_bytes("a", even(9, 9, 0.123F), options);
  options.dithers = true;
  EXPECT_EQ(display_bytes("a", even(9, 9, 0.123F), options), plain);
}

}  // namespace
}  // namespace splotchcl
