#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/curves.h"

namespace splotchcl {
namespace {

constexpr SplineKind all_kinds[] = {SplineKind::linear, SplineKind::natural, SplineKind::monotone};

const std::vector<double> uneven_knots = {-1, 0, 0.5, 4, 7};

TEST(Spline, PassesThroughItsValues) {
  const std::vector<double> values = {3, -2, 10, 10, 0.1};
  for (const SplineKind kind : all_kinds) {
    const Spline spline(uneven_knots, values, kind);
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_DOUBLE_EQ(spline.at(uneven_knots[i]), values[i]);
  }
}

TEST(Spline, OfAStraightLineIsTheLine) {
  std::vector<double> values;
  for (const double knot : uneven_knots)
    values.push_back(5 - 3 * knot);
  for (const SplineKind kind : all_kinds) {
    const Spline spline(uneven_knots, values, kind);
    for (double x = -1; x <= 7; x += 0.37)
      EXPECT_NEAR(spline.at(x), 5 - 3 * x, 1e-13);
  }
}

TEST(Spline, KeepsAConstantExactly) {
  for (const SplineKind kind : all_kinds) {
    const Spline spline(uneven_knots, {0.1, 0.1, 0.1, 0.1, 0.1}, kind);
    for (double x = -1; x <= 7; x += 0.37)
      EXPECT_EQ(spline.at(x), 0.1);
  }
}

TEST(Spline, StaysWhatItIsBeyondItsEnds) {
  for (const SplineKind kind : all_kinds) {
    const Spline spline({0, 1, 3}, {2, 5, 4}, kind);
    EXPECT_EQ(spline.at(-100), 2);
    EXPECT_EQ(spline.at(100), 4);
  }
}

TEST(Spline, OfOneValueIsThatValue) {
  for (const SplineKind kind : all_kinds)
    EXPECT_EQ(Spline({3}, {8}, kind).at(17), 8);
}

// By hand: knots 0, 1, 2 with values 0, 1, 0 have the second derivatives 0, -3, 0, which is
// the cubic 1.5 x - 0.5 x^3 on [0, 1].
TEST(NaturalSpline, IsTheKnownCubic) {
  const Spline spline({0, 1, 2}, {0, 1, 0}, SplineKind::natural);
  for (double x = 0; x <= 1; x += 0.125) {
    EXPECT_NEAR(spline.at(x), 1.5 * x - 0.5 * x * x * x, 1e-14);
    EXPECT_NEAR(spline.at(2 - x), spline.at(x), 1e-14);
  }
}

// The error of a natural spline away from its ends falls with the fourth power of the
// distance of its knots.
TEST(NaturalSpline, ConvergesWithTheFourthPower) {
  const auto error = [](int intervals) {
    std::vector<double> knots, values;
    for (int i = 0; i <= intervals; ++i) {
      knots.push_back(6.28 * i / intervals);
      values.push_back(std::sin(knots.back()));
    }
    const Spline spline(knots, values, SplineKind::natural);
    double largest = 0;
    for (double x = 2; x < 4; x += 0.01)
      largest = std::max(largest, std::abs(spline.at(x) - std::sin(x)));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4, 0.3);
}

TEST(MonotoneSpline, NeverLeavesTheIntervalOfItsNeighbors) {
  const std::vector<double> values = {0, 0, 100, 101, 1};
  const Spline spline(uneven_knots, values, SplineKind::monotone);
  for (double x = -1; x < 7; x += 0.01) {
    const std::size_t i = find_interval(uneven_knots, x);
    EXPECT_GE(spline.at(x), std::min(values[i], values[i + 1]) - 1e-12) << x;
    EXPECT_LE(spline.at(x), std::max(values[i], values[i + 1]) + 1e-12) << x;
  }
}

TEST(MonotoneSpline, HasNoCorners) {
  const Spline spline(uneven_knots, {0, 1, 3, 2, 5}, SplineKind::monotone);
  constexpr double h = 1e-6;
  for (const double knot : {0.0, 0.5, 4.0}) {
    const double before = (spline.at(knot) - spline.at(knot - h)) / h;
    const double after = (spline.at(knot + h) - spline.at(knot)) / h;
    EXPECT_NEAR(before, after, 1e-4);
  }
}

}  // namespace
}  // namespace splotchcl
