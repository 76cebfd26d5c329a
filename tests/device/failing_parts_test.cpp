#include "device/failing_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace splotchcl::test {
namespace {

constexpr int side = BlockErrors::block_pixels;
constexpr double promise = 1e-3;

// A picture of 40 by 30 blocks, but for half a one at the right and at the bottom.
constexpr int width = 40 * side - side / 2, height = 30 * side - side / 2;

BlockErrors failing_at(const std::vector<std::pair<int, int>>& places) {
  BlockErrors blocks(width, height);
  for (const auto& [x, y] : places)
    blocks.errors[static_cast<std::size_t>(y * blocks.columns + x)] = 2e-3F;
  return blocks;
}

std::vector<Rectangle> parts_of(const std::vector<std::pair<int, int>>& places) {
  return failing_parts(failing_at(places), promise, width, height);
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
  EXPECT_EQ(parts[0].x + parts[0].width, width);
  EXPECT_EQ(parts[0].y + parts[0].height, height);
}

TEST(FailingParts, AreSeparateForBlocksFarFromEachOther) {
  const std::vector<Rectangle> parts = parts_of({{0, 0}, {1, 1}, {38, 28}, {39, 29}});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_LE(pixels(parts), 8 * side * side);
}

TEST(FailingParts, AreAtMostFour) {
  EXPECT_LE(parts_of({{0, 0}, {39, 0}, {0, 29}, {39, 29}, {20, 15}, {10, 5}}).size(), 4U);
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
