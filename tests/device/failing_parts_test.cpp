#include "device/failing_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace splotchcl::test {
namespace {

constexpr int side = BlockErrors::block_pixels;
constexpr double promise = 1e-3;

// A picture of 40 by 30 blocks, but for half a one at the right and at the bottom.
constexpr int picture_width = 40 * side - side / 2, picture_height = 30 * side - side / 2;

BlockErrors failing_at(const std::vector<std::pair<int, int>>& places) {
  BlockErrors blocks(picture_width, picture_height);
  for (const auto& [x, y] : places)
    blocks.errors[static_cast<std::size_t>(y * blocks.columns + x)] = 2e-3F;
  return blocks;
}

// Where another part costs as much as so many blocks.
std::vector<Rectangle> parts_of(const std::vector<std::pair<int, int>>& places,
                                int blocks_of_part = 20) {
  return failing_parts(failing_at(places), promise, picture_width, picture_height,
                       blocks_of_part * side * side);
}

double pixels(const std::vector<Rectangle>& parts) {
  double sum = 0;
  for (const Rectangle& part : parts)
    sum += static_cast<double>(part.width) * part.height;
  return sum;
}

TEST(FailingParts, AreNoneWhereAllBlocksKeepThePromise) {
  EXPECT_TRUE(parts_of({}).empty());
}

TEST(FailingParts, AreTheBoundsOfBlocksThatLieTogether) {
  const std::vector<Rectangle> parts = parts_of({{3, 4}, {5, 4}, {4, 6}});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].x, 3 * side);
  EXPECT_EQ(parts[0].y, 4 * side);
  EXPECT_EQ(parts[0].width, 3 * side);
  EXPECT_EQ(parts[0].height, 3 * side);
}

TEST(FailingParts, EndWithThePicture) {
  const std::vector<Rectangle> parts = parts_of({{39, 29}});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].x + parts[0].width, picture_width);
  EXPECT_EQ(parts[0].y + parts[0].height, picture_height);
}

TEST(FailingParts, AreSeparateForBlocksFarFromEachOther) {
  const std::vector<Rectangle> parts = parts_of({{0, 0}, {1, 1}, {38, 28}, {39, 29}});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_LE(pixels(parts), 8 * side * side);
}

TEST(FailingParts, AreAsManyAsPay) {
  const std::vector<std::pair<int, int>> places = {{0, 0}, {4, 4}, {39, 0}, {39, 29}};
  EXPECT_EQ(parts_of(places, 0).size(), 4U);
  EXPECT_EQ(parts_of(places, 24).size(), 3U) << "25 blocks as one part, 2 as two";
  EXPECT_EQ(parts_of(places, 40 * 30).size(), 1U);
}

TEST(FailingParts, AreNoMoreThanTheirPixelsWhereTheyLieApart) {
  std::vector<std::pair<int, int>> places;
  for (int y = 0; y < 30; y += 5) {
    for (int x = y % 10; x < 40; x += 10)
      places.emplace_back(x, y);
  }
  const std::vector<Rectangle> parts = parts_of(places, 0);
  EXPECT_EQ(parts.size(), places.size());
  EXPECT_LE(pixels(parts), static_cast<double>(places.size()) * side * side);
}

TEST(FailingParts, AreAtMostSixtyFour) {
  std::vector<std::pair<int, int>> places;
  for (int y = 0; y < 30; y += 2) {
    for (int x = 0; x < 40; x += 2)
      places.emplace_back(x, y);
  }
  EXPECT_EQ(parts_of(places, 0).size(), 64U);
}

TEST(FailingParts, HoldEveryBlockThatFails) {
  const std::vector<std::pair<int, int>> places = {{0, 0}, {39, 0}, {0, 29}, {39, 29}, {20, 15}};
  const std::vector<Rectangle> parts = parts_of(places);
  for (const auto& [x, y] : places) {
    int holding = 0;
    for (const Rectangle& part : parts) {
      holding += x * side >= part.x && x * side < part.x + part.width && y * side >= part.y &&
                 y * side < part.y + part.height;
    }
    EXPECT_EQ(holding, 1) << x << ", " << y;
  }
}

}  // namespace
}  // namespace splotchcl::test
