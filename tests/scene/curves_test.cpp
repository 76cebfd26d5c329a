#include "scene/curves.h"

#include <boost/qvm/vec_operations.hpp>

#include "scene/constants.h"
#include "scene/expect_near.h"
#include "testing.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;
using test::expect_near;

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

Vec3 on_circle(double degrees) {
  const double angle = degrees * pi / 180;
  return {{std::cos(angle), std::sin(angle), 0}};
}

TEST(DirectionTrack, TurnsAtAConstantRateWhereItsKnotsDo) {
  for (const bool is_smooth : {false, true}) {
    const DirectionTrack track(
        {0, 1, 3, 7}, {on_circle(0), on_circle(30), on_circle(90), on_circle(210)}, is_smooth);
    for (double x = 0; x <= 7; x += 0.23)
      expect_near(track.at(x), on_circle(30 * x), 1e-14);
  }
}

TEST(DirectionTrack, PassesThroughItsDirectionsAtUnitLength) {
  const Vec3 directions[] = {{{2, 0, 0}}, {{1, 3, -1}}, {{0, 0, 5}}, {{-1, -1, -1}}};
  const DirectionTrack track({0, 1, 5, 6}, {directions, directions + 4}, true);
  const double knots[] = {0, 1, 5, 6};
  for (int i = 0; i < 4; ++i)
    expect_near(track.at(knots[i]), boost::qvm::normalized(directions[i]), 1e-14);
  for (double x = 0; x < 6; x += 0.1)
    EXPECT_NEAR(boost::qvm::mag(track.at(x)), 1, 1e-14);
}

TEST(DirectionTrack, KeepsAConstantDirection) {
  const Vec3 up = {{0, 0, 1}};
  const DirectionTrack track({0, 1, 5}, {up, up, up}, true);
  for (double x = -1; x < 6; x += 0.3)
    expect_near(track.at(x), up, 0);
}

TEST(DirectionTrack, ReachesTheOppositeDirectionByAHalfTurn) {
  const DirectionTrack track({0, 2}, {{{0, 0, 1}}, {{0, 0, -1}}}, true);
  EXPECT_NEAR(track.at(1).a[2], 0, 1e-14);
  EXPECT_NEAR(track.at(0.5).a[2], std::sqrt(0.5), 1e-14);
}

TEST(DirectionTrack, HasNoCornersWhereItIsSmooth) {
  const DirectionTrack track({0, 1, 3}, {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}, true);
  constexpr double h = 1e-6;
  const Vec3 before = (track.at(1) - track.at(1 - h)) / h;
  const Vec3 after = (track.at(1 + h) - track.at(1)) / h;
  expect_near(before, after, 1e-4);
}

TEST(DirectionTrack, StaysWhatItIsBeyondItsEnds) {
  const DirectionTrack track({0, 1}, {on_circle(0), on_circle(80)}, true);
  expect_near(track.at(-5), on_circle(0), 0);
  expect_near(track.at(9), on_circle(80), 1e-15);
}

TEST(Turned, GoesCounterclockwiseAboutItsAxis) {
  const Vec3 center = {{10, 20, 30}}, up = {{0, 0, 7}};
  expect_near(turned({{13, 20, 35}}, center, up, 90), {{10, 23, 35}}, 1e-14);
  expect_near(turned({{13, 20, 35}}, center, up, 360), {{13, 20, 35}}, 1e-14);
}

TEST(Turned, KeepsTheDistance) {
  const Vec3 center = {{1, 2, 3}}, axis = {{1, -1, 2}}, point = {{5, 7, -3}};
  for (double degrees = 0; degrees < 720; degrees += 33)
    EXPECT_NEAR(mag(turned(point, center, axis, degrees) - center), mag(point - center), 1e-13);
}

TEST(Flight, BetweenTwoPointsIsStraight) {
  const Flight flight({{{0, 0, 0}}, {{8, 4, -2}}});
  EXPECT_NEAR(flight.length(), std::sqrt(84.0), 1e-13);
  for (double part = 0; part <= 1; part += 0.125) {
    expect_near(flight.at(part).position, {{8 * part, 4 * part, -2 * part}}, 1e-13);
    expect_near(flight.at(part).direction, Vec3({{8, 4, -2}}) / std::sqrt(84.0), 1e-14);
  }
}

TEST(Flight, AlongALineHasTheSameSpeedBetweenNearAndFarPoints) {
  const Flight flight({{{0, 0, 0}}, {{1, 0, 0}}, {{10, 0, 0}}, {{12, 0, 0}}});
  // Steps of a segment, each of constant speed, of which there are 256: the fastest, next to
  // the long segment's ends, is 9 / 256 long and a few per cent faster at one of its ends.
  for (double part = 0; part <= 1; part += 1.0 / 64)
    EXPECT_NEAR(flight.at(part).position.a[0], 12 * part, 1e-3);
}

TEST(Flight, PassesThroughItsPoints) {
  const Vec3 corner = {{3, 4, 0}};
  const Flight flight({{{0, 0, 0}}, corner, {{6, 0, 0}}});
  expect_near(flight.at(0).position, {{0, 0, 0}}, 1e-14);
  expect_near(flight.at(0.5).position, corner, 1e-12);  // by symmetry
  expect_near(flight.at(1).position, {{6, 0, 0}}, 1e-14);
  expect_near(flight.at(0.5).direction, {{1, 0, 0}}, 1e-12);
}

// A regular 24-gon: between its points, and away from its ends, the curve keeps close to the
// circle. Half an angle between points spans 7.5 degrees, and the chord itself would be off
// by 1 - cos(7.5 degrees) = 8.6e-3.
TEST(Flight, AroundACircleIsNearlyOne) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 24; ++i)
    points.push_back({{std::cos(i * pi / 12), std::sin(i * pi / 12), 0}});
  const Flight flight(points);
  for (double part = 0.1; part < 0.9; part += 0.01) {
    const Flight::State state = flight.at(part);
    EXPECT_NEAR(mag(state.position), 1, 1e-3);
    EXPECT_NEAR(boost::qvm::dot(state.position, state.direction), 0, 1e-2);
  }
}

}  // namespace
}  // namespace splotchcl
