#include <gtest/gtest.h>

#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"
#include "scene/curves.h"
#include "scene/expect_near.h"

namespace splotchcl {
namespace {

using boost::qvm::mag;
using test::expect_near;

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
