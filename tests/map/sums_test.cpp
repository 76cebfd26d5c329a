#include "map/sums.h"

#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl {
namespace {

using testing::Ge;
using testing::SizeIs;

constexpr int side = 64;
const SumPicture picture = {side, side, 0.4, 1e-3};

// Ten pixels wide each, on a grid of four pixels, in columns of pixels from the middle on.
PlacedParticles even_gas(float left, float right) {
  PlacedParticles placed;
  std::uint32_t number = 0;
  for (float y = -48; y <= 48; y += 4) {
    for (float x = left; x <= right; x += 4) {
      placed.position.insert(placed.position.end(), {x, y, 0});
      placed.size.push_back(10);
      placed.source.push_back(number++);
      placed.share.push_back(1);
    }
  }
  return placed;
}

struct Drawing {
  Rectangle crop;
  double white;
};

// By the reference, which tells what it was asked for.
struct Drawings {
  std::vector<Drawing> all;
  DrawFrame draw = [this](const Frame& frame) {
    all.push_back({frame.crop, frame.components.front().reference_column});
    return reference::render(frame).to_float();
  };
};

std::vector<float> ones(const PlacedParticles& placed) {
  return std::vector<float>(placed.count(), 1.0F);
}

TEST(Sums, AreDrawnAsBrightAsTheirDarkestPixelIs) {
  const PlacedParticles placed = even_gas(-48, 48);
  Drawings drawings;
  const std::vector<float> weight = ones(placed);
  const PixelSums sums = draw_sums(placed, placed.size, {weight, {}, 1e-6}, picture, drawings.draw);
  ASSERT_THAT(drawings.all, SizeIs(1));
  EXPECT_GT(drawings.all.front().white, 0.01);
  EXPECT_THAT(sums[0], Each(Ge(drawings.all.front().white)));
}

TEST(Sums, AreDrawnAgainWhereTheyAreDarkerThanWasExpected) {
  // The last columns have nothing, the rest is even.
  const PlacedParticles placed = even_gas(-48, 16);
  Drawings drawings;
  const std::vector<float> weight = ones(placed);
  const PixelSums sums = draw_sums(placed, placed.size, {weight, {}, 1e-6}, picture, drawings.draw);
  const Drawing& last = drawings.all.back();
  const double least = *std::min_element(sums[0].begin(), sums[0].end());
  EXPECT_TRUE(last.white <= least || last.white == 1e-6);
  for (const Drawing& drawing : drawings.all)
    EXPECT_GE(drawing.white, 1e-6);
}

TEST(Sums, OfTwoPartsAreAsDarkAsBothTogether) {
  const PlacedParticles placed = even_gas(-48, 48);
  const std::vector<float> weight = ones(placed);
  SumRequest request = {weight, {}, 1e-6};
  // Above 0 on the left, below it on the right: no pixel is without.
  request.factors.assign(3 * placed.count(), 0.0F);
  for (std::size_t i = 0; i < placed.count(); ++i) {
    request.factors[3 * i] = 1;
    request.factors[3 * i + (placed.position[3 * i] < 0 ? 1 : 2)] = 1;
  }
  Drawings drawings;
  const PixelSums sums = draw_sums(placed, placed.size, request, picture, drawings.draw);
  ASSERT_THAT(drawings.all, SizeIs(1));
  EXPECT_GT(drawings.all.front().white, 0.01);
  EXPECT_LT(*std::min_element(sums[1].begin(), sums[1].end()), 1e-6);
}

TEST(Sums, HaveNoFloorBelowTheDigitsOfTheBrightestParticle) {
  const PlacedParticles placed = even_gas(-48, 48);
  const std::vector<float> weight = ones(placed);
  const double peak = 1 / (3.14159265358979 * 16);
  EXPECT_NEAR(least_floor(placed.size, weight, {}, 0.4), 0x1p-50 * peak, 1e-22);
}

TEST(Sums, OfNothingAreNothing) {
  Drawings drawings;
  const PixelSums sums = draw_sums({}, {}, {std::vector<float>(), {}, 1}, picture, drawings.draw);
  EXPECT_THAT(drawings.all, SizeIs(0));
  for (const std::vector<double>& sum : sums)
    EXPECT_EQ(sum, std::vector<double>(std::size_t{side} * side));
}

}  // namespace
}  // namespace splotchcl
