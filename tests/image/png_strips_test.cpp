// Data of PNG files, strip by strip.
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "image/png_file.h"

namespace splotchcl {
namespace {

std::vector<unsigned char> noise(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> values(0, 255);
  std::vector<unsigned char> bytes(count);
  for (unsigned char& byte : bytes)
    byte = static_cast<unsigned char>(values(random));
  return bytes;
}

// As a reader does: one stream, then each row from the differences to the pixel on its left.
std::vector<unsigned char> read(const std::vector<std::vector<unsigned char>>& strips,
                                const PngRows& picture) {
  std::vector<unsigned char> stream;
  for (const std::vector<unsigned char>& strip : strips)
    stream.insert(stream.end(), strip.begin(), strip.end());
  std::vector<unsigned char> filtered(picture.rows * (picture.row_bytes + 1));
  uLongf size = filtered.size();
  EXPECT_EQ(uncompress(filtered.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, filtered.size());
  std::vector<unsigned char> bytes;
  for (std::size_t row = 0; row < picture.rows; ++row) {
    const std::size_t first = bytes.size();
    const unsigned char* from = filtered.data() + row * (picture.row_bytes + 1);
    EXPECT_EQ(*from++, 1);
    for (std::size_t i = 0; i < picture.row_bytes; ++i) {
      const int left = i < picture.pixel_bytes ? 0 : bytes[first + i - picture.pixel_bytes];
      bytes.push_back(static_cast<unsigned char>(from[i] + left));
    }
  }
  return bytes;
}

// How many they are of these rows, which are read as they were.
std::size_t strips_of(const std::vector<unsigned char>& bytes, std::size_t row_bytes,
                      std::size_t pixel_bytes) {
  const PngRows picture = {bytes.data(), row_bytes, bytes.size() / row_bytes, pixel_bytes};
  const std::vector<std::vector<unsigned char>> strips = png_strips(picture);
  EXPECT_EQ(read(strips, picture), bytes);
  return strips.size();
}

TEST(PngStrips, AreOneStreamOfAllRows) {
  constexpr std::size_t row_bytes = 3 * 731, rows = 600;
  EXPECT_GT(strips_of(noise(row_bytes * rows), row_bytes, 3), 4U);
}

TEST(PngStrips, HoldRowsThatAreLongerThanAStrip) {
  constexpr std::size_t row_bytes = 6 * 60000, rows = 3;
  EXPECT_EQ(strips_of(noise(row_bytes * rows), row_bytes, 6), 3U);
}

TEST(PngStrips, AreOneForASinglePixel) {
  EXPECT_EQ(strips_of({1, 200, 3}, 3, 3), 1U);
}

}  // namespace
}  // namespace splotchcl
