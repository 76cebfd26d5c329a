#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {
namespace {

using Color = std::array<double, 3>;

const std::vector<Rgb> three_knots = {{0, 0.25f, 1}, {0.5f, 0.75f, 0}, {1, 0.25f, 0.5f}};

TEST(PaletteSampling, GivesTheKnotsAtEvenSteps) {
  EXPECT_EQ(sample_knots(three_knots, 0), (Color{0, 0.25, 1}));
  EXPECT_EQ(sample_knots(three_knots, 0.5), (Color{0.5, 0.75, 0}));
  EXPECT_EQ(sample_knots(three_knots, 1), (Color{1, 0.25, 0.5}));
}

TEST(PaletteSampling, IsLinearBetweenTheKnots) {
  // Quarters and these knots are exact in binary, so are the results.
  EXPECT_EQ(sample_knots(three_knots, 0.25), (Color{0.25, 0.5, 0.5}));
  EXPECT_EQ(sample_knots(three_knots, 0.625), (Color{0.625, 0.625, 0.125}));
}

TEST(PaletteSampling, IsConstantOutside) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double below : {-1e-300, -1.0, -infinity}) {
    EXPECT_EQ(sample_knots(three_knots, below), sample_knots(three_knots, 0)) << below;
  }
  for (const double above : {1.0000001, 2.0, infinity}) {
    EXPECT_EQ(sample_knots(three_knots, above), sample_knots(three_knots, 1)) << above;
  }
}

TEST(PaletteSampling, GivesTheFirstKnotForWhatIsNotANumber) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sample_knots(three_knots, not_a_number), sample_knots(three_knots, 0));
}

TEST(PaletteSampling, OfASingleKnotIsThatColorEverywhere) {
  for (const double position : {-1.0, 0.0, 0.3, 1.0, 5.0}) {
    EXPECT_EQ(sample_knots({{0.25f, 0.5f, 0.75f}}, position), (Color{0.25, 0.5, 0.75})) << position;
  }
}

TEST(PaletteSampling, KeepsAStraightLineStraightForAnyNumberOfKnots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (std::size_t count = 2; count < 300; ++count) {
    std::vector<Rgb> line;
    for (std::size_t i = 0; i < count; ++i) {
      const float value = static_cast<float>(i) / static_cast<float>(count - 1);
      line.push_back({value, value, value});
    }
    const double position = anywhere(random);
    // The knots are rounded to single precision: 2^-25 at most for values up to 1.
    EXPECT_NEAR(sample_knots(line, position)[0], position, std::ldexp(1, -25) + 1e-15);
  }
}

TEST(PaletteSampling, StaysBetweenNeighboringKnotsAtTheLastBitBelowOne) {
  const Color color = sample_knots(three_knots, std::nextafter(1.0, 0.0));
  EXPECT_NEAR(color[0], 1, 1e-15);
  EXPECT_LE(color[0], 1);
}

}  // namespace
}  // namespace splotchcl
