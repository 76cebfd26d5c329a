#include "splotchcl/turning_galaxy.h"

#include "galaxy/galaxy_picture.h"
#include "index/snapshot_index.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using boost::qvm::mag;

constexpr Vec3 z_axis = {{0, 0, 1}};

TurningSettings first_order(double step_myr) {
  TurningSettings settings;
  settings.integrator = OrbitIntegrator::first_order;
  settings.step_myr = step_myr;
  return settings;
}

TEST(Orbit, ClosesAfterOnePeriodWithTheExactIntegrator) {
  const double angular_speed = 0.025;
  const OrbitState start = {{{3, -4, 0.5}}, {{100, 75, 0}}};
  for (const double turns : {1.0, 2.0, 10.0}) {
    const OrbitState end =
        move_on_orbit(start, z_axis, angular_speed, turns * 2 * M_PI / angular_speed, {});
    EXPECT_LT(mag(end.position - start.position), 1e-12 * turns);
    EXPECT_LT(mag(end.velocity - start.velocity), 1e-10 * turns);
  }
}

TEST(Orbit, ExactCirclesKeepRadiusAndHeightAndSpeed) {
  const Vec3 axis = {{0.6, 0, 0.8}};
  const OrbitState start = {{{3, -4, 0.5}}, {{100, 75, 0}}};
  for (const double myr : {1.0, 33.3, 250.0}) {
    const OrbitState end = move_on_orbit(start, axis, 0.03, myr, {});
    EXPECT_NEAR(mag(end.position), mag(start.position), 1e-12);
    EXPECT_NEAR(boost::qvm::dot(end.position, axis), boost::qvm::dot(start.position, axis), 1e-12);
    EXPECT_NEAR(mag(end.velocity), mag(start.velocity), 1e-10);
  }
}

TEST(Orbit, TurnsCounterClockwiseSeenFromItsAxis) {
  const OrbitState end = move_on_orbit({{{1, 0, 0}}, {{0, 1, 0}}}, z_axis, 0.01, 10, {});
  EXPECT_NEAR(end.position.a[0], std::cos(0.1), 1e-15);
  EXPECT_NEAR(end.position.a[1], std::sin(0.1), 1e-15);
}

// Steps one after the other, by the definition.
TEST(Orbit, FirstOrderIsStepsAlongTheTangent) {
  const double angular_speed = 0.02, step = 5;
  Vec3 place = {{3, -4, 0.5}};
  const OrbitState start = {place, {{0, 0, 0}}};
  for (int i = 0; i < 20; ++i)
    place += boost::qvm::cross(z_axis, place) * (angular_speed * step);
  const OrbitState end = move_on_orbit(start, z_axis, angular_speed, 20 * step, first_order(step));
  EXPECT_LT(mag(end.position - place), 1e-12);
}

// A step of the angle a = angular speed * step moves a distance a r along the tangent, so the
// radius grows by sqrt(1 + a^2) each: after n steps r (1 + a^2)^(n/2), and the place is atan(a)
// instead of a around. Over a fixed time both errors shrink like the step and its square.
TEST(Orbit, FirstOrderDriftsByItsError) {
  const double angular_speed = 0.02, radius = 5, time = 100;
  const OrbitState start = {{{radius, 0, 0}}, {{0, 0, 0}}};
  for (const int steps : {10, 20, 40}) {
    const double angle = angular_speed * time / steps;
    const Vec3 end =
        move_on_orbit(start, z_axis, angular_speed, time, first_order(time / steps)).position;
    EXPECT_NEAR(mag(end), radius * std::pow(1 + angle * angle, steps / 2.0), 1e-9);
    EXPECT_NEAR(std::atan2(end.a[1], end.a[0]), steps * std::atan(angle), 1e-12);
    // To leading order: (wt)^2 / (2 n) of the radius.
    EXPECT_NEAR((mag(end) / radius - 1) / (4.0 / (2 * steps)), 1, 2.5 / steps);
  }
}

TEST(TurningGalaxy, MovesEveryKindOnItsCircle) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const std::shared_ptr<const Snapshot> start = open_snapshot(folder / "galaxy.hdf5");
  const TurningGalaxy galaxy(start, {});
  const auto later = galaxy.at(100);
  for (const int type : {0, 2, 3, 4}) {
    const Column before = start->read(type, "position"), after = later->read(type, "position");
    const Column radius = start->read(type, "OrbitRadius");
    double moved = 0;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      const auto distance = [i](const Column& p) {
        return std::hypot(static_cast<double>(p[3 * i]), static_cast<double>(p[3 * i + 1]),
                          static_cast<double>(p[3 * i + 2]));
      };
      ASSERT_NEAR(distance(after), distance(before), 1e-5 * (1 + distance(before)));
      moved += std::abs(static_cast<double>(after[3 * i] - before[3 * i]));
    }
    EXPECT_GT(moved / static_cast<double>(radius.size()), 0.1) << "type " << type;
    EXPECT_EQ(later->read(type, "Color").data()[0], start->read(type, "Color").data()[0]);
  }
}

// The boxes of an index are those of a galaxy that has not turned.
TEST(TurningGalaxy, DoesWithoutTheIndexOfItsFile) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const std::shared_ptr<const Snapshot> start = open_snapshot(folder / "galaxy.hdf5");
  SnapshotIndex::make(*start, {}).write(start->info());
  EXPECT_TRUE(SnapshotIndex::read(start->info()));
  EXPECT_FALSE(SnapshotIndex::read(TurningGalaxy(start, {}).at(100)->info()));
}

TEST(TurningGalaxy, ACurveReplacesTheVelocitiesSpeeds) {
  const std::vector<float> position = {2, 0, 0}, velocity = {0, 50, 0}, axis = {0, 0, 1},
                           radius = {2};
  const auto arrays = std::make_shared<ArraySnapshot>();
  arrays->set_field(0, "position", position.data(), 1, 3);
  arrays->set_field(0, "velocity", velocity.data(), 1, 3);
  arrays->set_field(0, "OrbitAxis", axis.data(), 1, 3);
  arrays->set_field(0, "OrbitRadius", radius.data(), 1);
  const auto angle = [&](const TurningSettings& settings) {
    const Column place = TurningGalaxy(arrays, settings).at(10)->read(0, "position");
    return std::atan2(place[1], place[0]);
  };
  EXPECT_NEAR(angle({}), 50.0 / 2 * 10 / myr_per_kpc_s_km, 1e-6);
  TurningSettings faster;
  faster.curve = RotationCurve::table({1, 3}, {100, 100});
  EXPECT_NEAR(angle(faster), 100.0 / 2 * 10 / myr_per_kpc_s_km, 1e-6);
}

TEST(TurningGalaxy, SnapshotsOfItsCourseCanBeTurnedOn) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const TurningGalaxy galaxy(open_snapshot(folder / "galaxy.hdf5"), {});
  write_galaxy_snapshot(folder / "later.hdf5", *galaxy.at(40), 40);
  const std::shared_ptr<const Snapshot> written = open_snapshot(folder / "later.hdf5");
  EXPECT_EQ(written->info().time, 40);
  EXPECT_EQ(written->read_ids(2), galaxy.start()->read_ids(2));
  const Column expected = galaxy.at(90)->read(3, "position");
  const Column found = TurningGalaxy(written, {}).at(50)->read(3, "position");
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_NEAR(found[i], expected[i], 1e-4);
}

// Matter on a flat curve at 4 kpc, half of the light inside of it.
std::shared_ptr<ArraySnapshot> ring_on_a_flat_curve(std::vector<float>& values) {
  constexpr int count = 400;
  values.assign(11 * count, 0);
  float *const position = values.data(), *const velocity = position + 3 * count,
               *const axis = velocity + 3 * count, *const radius = axis + 3 * count;
  static const std::vector<float> mass(count, 1), color(3 * count, 1);
  for (int i = 0; i < count; ++i) {
    radius[i] = 2 + 4 * (static_cast<float>(i) + 0.5F) / count;
    position[3 * i] = radius[i];
    velocity[3 * i + 1] = 200;
    axis[3 * i + 2] = 1;
  }
  const auto arrays = std::make_shared<ArraySnapshot>();
  arrays->set_field(0, "position", position, count, 3);
  arrays->set_field(0, "velocity", velocity, count, 3);
  arrays->set_field(0, "OrbitAxis", axis, count, 3);
  arrays->set_field(0, "OrbitRadius", radius, count);
  arrays->set_field(0, "mass", mass.data(), count);
  arrays->set_field(0, "Color", color.data(), count, 3);
  return arrays;
}

// With a flat curve the angular speed v / r falls by itself for each e-fold of the radius.
TEST(TurningGalaxy, ArmsHoldUntilTheirPitchHasHalved) {
  std::vector<float> values;
  const auto ring = ring_on_a_flat_curve(values);
  const double angular_speed = 200.0 / 4 / myr_per_kpc_s_km;
  const double expected = 1 / (std::tan(20 * M_PI / 180) * angular_speed);
  const auto found = arms_hold_myr(*ring, {});
  ASSERT_TRUE(found);
  // The angular speeds are means over a tenth of the radius to both sides.
  EXPECT_NEAR(*found / expected, 1, 0.03);
  EXPECT_FALSE(turning_warning(*found, found));
  ASSERT_TRUE(turning_warning(2 * *found, found));
  EXPECT_THAT(*turning_warning(2 * *found, found), HasSubstr("wind up"));
}

TEST(TurningGalaxy, ArmsOfASolidBodyAndOfAPatternHoldForEver) {
  std::vector<float> values;
  const auto ring = ring_on_a_flat_curve(values);
  TurningSettings solid;
  solid.curve = RotationCurve::table({1, 100}, {10, 1000});
  EXPECT_FALSE(arms_hold_myr(*ring, solid));
  TurningSettings pattern;
  pattern.pattern_speed = 40;
  EXPECT_FALSE(arms_hold_myr(*ring, pattern));
}

TEST(TurningGalaxy, APatternTurnsTheDiskAsAWholeAndNotTheBulge) {
  const TemporaryFolder folder;
  write_galaxy(folder / "galaxy.hdf5", make_galaxy(DiskPicture().draw(), small_settings()));
  const std::shared_ptr<const Snapshot> start = open_snapshot(folder / "galaxy.hdf5");
  TurningSettings settings;
  settings.pattern_speed = 40;
  const double quarter = M_PI / 2 * myr_per_kpc_s_km / 40;
  const auto later = TurningGalaxy(start, settings).at(quarter);
  for (const int type : {0, 2, 5}) {
    const Column before = start->read(type, "position"), after = later->read(type, "position");
    for (std::size_t i = 0; i < before.size(); i += 3) {
      ASSERT_NEAR(after[i], -before[i + 1], 1e-5) << "type " << type;
      ASSERT_NEAR(after[i + 1], before[i], 1e-5);
    }
  }
  EXPECT_EQ(TurningGalaxy(start, {}).at(quarter)->read(3, "position")[0],
            later->read(3, "position")[0]);
}

TEST(TurningGalaxy, WhatHasNoOrbitsIsRefused) {
  const std::vector<float> position = {2, 0, 0};
  const auto arrays = std::make_shared<ArraySnapshot>();
  arrays->set_field(0, "position", position.data(), 1, 3);
  EXPECT_THROW(TurningGalaxy(arrays, {}), DataError);
  EXPECT_THROW(TurningGalaxy(std::make_shared<ArraySnapshot>(), first_order(0)), UsageError);
  TurningSettings backwards;
  backwards.pattern_speed = -40;
  EXPECT_THROW(TurningGalaxy(std::make_shared<ArraySnapshot>(), backwards), UsageError);
}

}  // namespace
}  // namespace splotchcl::test
