#include <gtest/gtest.h>

#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"
#include "scene/curves.h"
#include "scene/expect_near.h"

namespace splotchcl {
namespace {

using test::expect_near;

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

}  // namespace
}  // namespace splotchcl
