// Particles between two snapshots against closed forms.
#include "between/interpolation.h"

#include "sequence/moving_snapshot.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using ::testing::FloatEq;

// Stored coordinates and results are rounded to single precision once each.
constexpr double rounding = 2.5e-7;

TEST(LinearPositions, LieOnStraightLines) {
  const auto first = MovingSnapshot(0).ids(0, {1, 2}).positions(0, {0, 0, 0, 10, 10, 10}).make();
  const auto second = MovingSnapshot(1).ids(0, {1, 2}).positions(0, {4, 8, -4, 10, 10, 10}).make();
  EXPECT_THAT(values(between(first, second, 0.25), "position"), ElementsAre(1, 2, -1, 10, 10, 10));
}

TEST(LinearPositions, FollowIdsThatAreInAnotherOrder) {
  const auto first =
      MovingSnapshot(0).ids(0, {7, 8, 9}).positions(0, {0, 0, 0, 10, 0, 0, 20, 0, 0}).make();
  const auto second =
      MovingSnapshot(1).ids(0, {9, 7, 8}).positions(0, {22, 0, 0, 2, 0, 0, 12, 0, 0}).make();
  const InterpolatedSnapshot middle = between(first, second, 0.5);
  EXPECT_THAT(values(middle, "position"), ElementsAre(1, 0, 0, 11, 0, 0, 21, 0, 0));
  EXPECT_THAT(middle.read_ids(0), ElementsAre(7, 8, 9));
}

TEST(WholeNumbers, AreThoseOfTheFirstSnapshotThatHasTheParticle) {
  const std::vector<float> halo_ids = {1, 3, 1};
  const auto first = MovingSnapshot(0)
                         .ids(0, {7, 8})
                         .positions(0, {0, 0, 0, 10, 0, 0})
                         .field(0, "tracer", {40, 50})
                         .field(0, "halo_id", {1, 3})
                         .make();
  const auto second = MovingSnapshot(1)
                          .ids(0, {9, 7, 8})
                          .positions(0, {22, 0, 0, 2, 0, 0, 12, 0, 0})
                          .field(0, "tracer", {60, 70, 80})
                          .field(0, "halo_id", {1, 3, 1})
                          .make();
  const InterpolatedSnapshot middle = between(first, second, 0.5);
  EXPECT_THAT(middle.read_integers(0, "tracer"), ElementsAre(40, 50, 60));
  EXPECT_EQ(values(middle, "halo_id"), halo_ids);
  EXPECT_THROW(middle.read_integers(0, "halo_id"), UsageError);
}

TEST(LinearPositions, TellApartIdsBeyondSinglePrecision) {
  constexpr std::uint64_t large = std::uint64_t{1} << 63;
  const auto first =
      MovingSnapshot(0).ids(0, {large, large + 1}).positions(0, {0, 0, 0, 8, 0, 0}).make();
  const auto second =
      MovingSnapshot(1).ids(0, {large + 1, large}).positions(0, {8, 0, 0, 0, 0, 0}).make();
  EXPECT_THAT(values(between(first, second, 0.5), "position"), ElementsAre(0, 0, 0, 8, 0, 0));
}

TEST(LinearPositions, TakeTheShorterWayThroughThePeriodicBoundary) {
  const auto first =
      MovingSnapshot(0).box(100).ids(0, {1, 2}).positions(0, {98, 2, 50, 3, 1, 1}).make();
  const auto second =
      MovingSnapshot(1).box(100).ids(0, {1, 2}).positions(0, {2, 98, 54, 5, 1, 1}).make();
  EXPECT_THAT(values(between(first, second, 0.25), "position"), ElementsAre(99, 1, 51, 3.5, 1, 1));
  EXPECT_THAT(values(between(first, second, 0.75), "position"), ElementsAre(1, 99, 53, 4.5, 1, 1));
}

TEST(LinearPositions, TakeTheShorterWayInABoxOfThreeSides) {
  const BoxSides sides(Vec3{{100, 20, 60}});
  const auto first =
      MovingSnapshot(0).box(sides).ids(0, {1, 2}).positions(0, {98, 19, 2, 30, 8, 31}).make();
  const auto second =
      MovingSnapshot(1).box(sides).ids(0, {1, 2}).positions(0, {2, 3, 58, 70, 12, 29}).make();
  EXPECT_THAT(values(between(first, second, 0.25), "position"), ElementsAre(99, 0, 1, 40, 9, 30.5));
  EXPECT_THAT(values(between(first, second, 0.75), "position"),
              ElementsAre(1, 2, 59, 60, 11, 29.5));
}

TEST(LinearPositions, StayInABoxAroundTheOrigin) {
  const auto first = MovingSnapshot(0).box(100).ids(0, {1}).positions(0, {48, 0, 0}).make();
  const auto second = MovingSnapshot(1).box(100).ids(0, {1}).positions(0, {-48, 0, 0}).make();
  EXPECT_THAT(values(between(first, second, 0.75), "position"), ElementsAre(-49, 0, 0));
}

// Codes put them back into the box only now and then, and sums are rounded.
TEST(LinearPositions, AreWrappedWhereOneParticleHasJustLeftTheBox) {
  const auto first =
      MovingSnapshot(0).box(100).ids(0, {1, 2}).positions(0, {98, 0, 0, 100.5f, 0, 0}).make();
  const auto second =
      MovingSnapshot(1).box(100).ids(0, {1, 2}).positions(0, {2, 0, 0, 1, 0, 0}).make();
  EXPECT_THAT(values(between(first, second, 0.75), "position"), ElementsAre(1, 0, 0, 0.875f, 0, 0));
}

TEST(LinearPositions, AreNotWrappedWhereParticlesLieOutsideOfTheBox) {
  const auto first = MovingSnapshot(0).box(10).ids(0, {1}).positions(0, {-40, 0, 0}).make();
  const auto second = MovingSnapshot(1).box(10).ids(0, {1}).positions(0, {40, 0, 0}).make();
  EXPECT_THAT(values(between(first, second, 0.75), "position"), ElementsAre(20, 0, 0));
}

// As few as those of which a run has lost sight do not end the period of all others.
TEST(LinearPositions, AreWrappedWhereFewParticlesLieFarOutsideOfTheBox) {
  constexpr std::uint64_t count = 100;
  std::vector<std::uint64_t> ids(count);
  std::iota(ids.begin(), ids.end(), 1);
  std::vector<float> before(3 * count, 98), after(3 * count, 2);
  before[0] = before[1] = before[2] = 298;
  const auto first = MovingSnapshot(0).box(100).ids(0, ids).positions(0, before).make();
  const auto second = MovingSnapshot(1).box(100).ids(0, ids).positions(0, after).make();
  const InterpolatedSnapshot middle = between(first, second, 0.75);
  EXPECT_THAT(values(middle, "position"), Each(1));
  EXPECT_THAT(interpolated(middle.read(0, "position"))->interpolation().note,
              HasSubstr("1 of 200 particles of both snapshots lie farther outside of the periodic "
                        "box of 100 than a hundredth of its side: they are drawn at their images"));
}

TEST(LinearPositions, TellWhereTheBoxIsNotUsed) {
  const auto first = MovingSnapshot(0).box(10).ids(0, {1}).positions(0, {-40, 0, 0}).make();
  const auto second = MovingSnapshot(1).box(10).ids(0, {1}).positions(0, {40, 0, 0}).make();
  EXPECT_THAT(interpolated(between(first, second, 0.5).read(0, "position"))->interpolation().note,
              HasSubstr("the box is not used"));
}

TEST(LinearPositions, HoldForSnapshotsOfDifferentOrigins) {
  const auto first =
      MovingSnapshot(0).origin({{1e9, 0, 0}}).ids(0, {1}).positions(0, {1, 0, 0}).make();
  const auto second =
      MovingSnapshot(1).origin({{1e9 + 8, 0, 0}}).ids(0, {1}).positions(0, {-5, 0, 0}).make();
  const InterpolatedSnapshot middle = between(first, second, 0.5);
  EXPECT_EQ(middle.position_origin().a[0], 1e9);
  EXPECT_THAT(values(middle, "position"), ElementsAre(2, 0, 0));
}

// x = 3 - 2 t + t^2 + t^3 / 2, and so for y with other coefficients, over t = 1 .. 3.
struct CubicOrbit {
  static double x(double t) { return 3 - 2 * t + t * t + 0.5 * t * t * t; }
  static double vx(double t) { return -2 + 2 * t + 1.5 * t * t; }
  static double y(double t) { return 1 + t - 0.25 * t * t * t; }
  static double vy(double t) { return 1 - 0.75 * t * t; }
};

std::shared_ptr<const SequenceMember> on_cubic(double t) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return MovingSnapshot(t)
      .ids(0, {5})
      .positions(0, {f(CubicOrbit::x(t)), f(CubicOrbit::y(t)), 0})
      .velocities(0, {f(CubicOrbit::vx(t)), f(CubicOrbit::vy(t)), 0})
      .make();
}

TEST(HermitePositions, AreExactOnACubicOrbit) {
  for (const double fraction : {0.1, 0.5, 0.8}) {
    const double t = 1 + 2 * fraction;
    const auto at =
        values(between(on_cubic(1), on_cubic(3), fraction, Interpolation::hermite), "position");
    EXPECT_NEAR(static_cast<double>(at[0]), CubicOrbit::x(t), 20 * rounding);
    EXPECT_NEAR(static_cast<double>(at[1]), CubicOrbit::y(t), 20 * rounding);
  }
}

TEST(HermitePositions, AreExactBackwardsInTime) {
  const auto at =
      values(between(on_cubic(3), on_cubic(1), 0.25, Interpolation::hermite), "position");
  EXPECT_NEAR(static_cast<double>(at[0]), CubicOrbit::x(2.5), 20 * rounding);
}

// A sixth of a circle: the error of the cubic is at most (2 pi / 6)^4 / 384 r = 3.1e-3 r (the
// fourth derivative of a circle is r), where the straight line misses by 0.13 r.
TEST(HermitePositions, FollowACircularOrbitToFourthOrder) {
  const double pi = std::acos(-1.0), angle = pi / 3;
  const auto on_circle = [](double t) {
    const auto f = [](double value) { return static_cast<float>(value); };
    return MovingSnapshot(t)
        .ids(0, {1})
        .positions(0, {f(std::cos(t)), f(std::sin(t)), 0})
        .velocities(0, {f(-std::sin(t)), f(std::cos(t)), 0})
        .make();
  };
  const auto at =
      values(between(on_circle(0), on_circle(angle), 0.5, Interpolation::hermite), "position");
  const double miss = std::hypot(static_cast<double>(at[0]) - std::cos(angle / 2),
                                 static_cast<double>(at[1]) - std::sin(angle / 2));
  EXPECT_LT(miss, std::pow(angle, 4) / 384 + rounding);
}

TEST(HermitePositions, WrapWhatTheCurveCarriesOutOfTheBox) {
  // Out through the upper face and back: at the middle the curve is (m0 - m1) / 8 above.
  const auto first = MovingSnapshot(0)
                         .box(100)
                         .ids(0, {1})
                         .positions(0, {98, 1, 1})
                         .velocities(0, {40, 0, 0})
                         .make();
  const auto second = MovingSnapshot(1)
                          .box(100)
                          .ids(0, {1})
                          .positions(0, {98, 3, 1})
                          .velocities(0, {-40, 0, 0})
                          .make();
  const auto at = values(between(first, second, 0.5, Interpolation::hermite), "position");
  EXPECT_FLOAT_EQ(at[0], 8);
}

// In a universe of matter alone with H0 = 2, H = 2 a^-1.5; a particle with dx/da = 1 has
// the peculiar velocity a dx/dt = a^2 H = 2 a^0.5, which Gadget stores divided by a^0.5.
TEST(HermitePositions, TakeGadgetsVelocitiesOverTheScaleFactor) {
  const auto at_scale = [](double a) {
    Cosmology cosmology;
    cosmology.scale_factor = a;
    cosmology.omega_matter = 1;
    cosmology.hubble_rate = 2;
    // x = a^2: dx/da = 2 a, a quadratic that the cubic holds exactly.
    return MovingSnapshot(a)
        .cosmology(cosmology)
        .ids(0, {1})
        .positions(0, {static_cast<float>(a * a), 0, 0})
        .velocities(0, {static_cast<float>(2 * a * 2), 0, 0})
        .make();
  };
  const auto middle = between(at_scale(0.25), at_scale(1), 0.5, Interpolation::hermite);
  EXPECT_NEAR(static_cast<double>(values(middle, "position")[0]), 0.625 * 0.625, 4 * rounding);
  EXPECT_DOUBLE_EQ(middle.info().cosmology->scale_factor, 0.625);
  EXPECT_DOUBLE_EQ(*middle.info().redshift, 1 / 0.625 - 1);
}

TEST(HermitePositions, AreRefusedWithoutVelocities) {
  const auto first = MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).make();
  const auto second = MovingSnapshot(1).ids(0, {1}).positions(0, {0, 0, 0}).make();
  EXPECT_THAT([&] { between(first, second, 0.5, Interpolation::hermite); },
              ThrowsMessage<UsageError>(
                  AllOf(HasSubstr("which needs velocities"), HasSubstr("\"linear\""))));
}

TEST(HermitePositions, AreRefusedWhereVelocitiesMayMeanAnything) {
  const auto make = [](double time) {
    return MovingSnapshot(time)
        .velocity_doubt("its units are not known")
        .ids(0, {1})
        .positions(0, {0, 0, 0})
        .velocities(0, {1, 0, 0})
        .make();
  };
  EXPECT_THROW(between(make(0), make(1), 0.5, Interpolation::hermite), UsageError);
}

TEST(HermitePositions, AreRefusedWithoutTimeBetween) {
  EXPECT_THROW(between(on_cubic(1), on_cubic(1), 0.5, Interpolation::hermite), UsageError);
}

TEST(HermitePositions, AreRefusedWhereVelocitiesAreInOtherUnits) {
  const auto make = [](double time, float x) {
    return MovingSnapshot(time)
        .ids(0, {1})
        .positions(0, {x, 0, 0})
        .velocities(0, {1000, 0, 0})  // where x moves by 1
        .make();
  };
  EXPECT_THROW(between(make(0, 0), make(1, 1), 0.5, Interpolation::hermite), UsageError);
}

// Twice around a circle and a little: the velocities tell nothing of where it went.
TEST(HermitePositions, AreDoubtedWhereParticlesTurnInBetween) {
  const auto make = [](double time, float x) {
    return MovingSnapshot(time)
        .ids(0, {1})
        .positions(0, {x, 0, 0})
        .velocities(0, {20, 0, 0})
        .make();
  };
  const InterpolatedSnapshot middle = between(make(0, 0), make(1, 1), 0.5, Interpolation::hermite);
  EXPECT_THAT(middle.info().notes, Contains(HasSubstr("closer together")));
}

TEST(Fields, AreLinearOrLogarithmicByTheirKind) {
  const auto make = [](float density, float other) {
    return MovingSnapshot(0)
        .ids(0, {1, 2})
        .positions(0, {0, 0, 0, 1, 1, 1})
        .field(0, "density", {density, 0})
        .field(0, "metallicity", {other, other})
        .make();
  };
  const InterpolatedSnapshot middle = between(make(1, 1), make(100, 100), 0.5);
  EXPECT_THAT(values(middle, "density"), ElementsAre(FloatEq(10), 0));
  EXPECT_THAT(values(middle, "metallicity"), ElementsAre(FloatEq(50.5), FloatEq(50.5)));
}

TEST(Fields, ThatFallToZeroGoThereLinearly) {
  const auto first =
      MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).field(0, "density", {8}).make();
  const auto second =
      MovingSnapshot(1).ids(0, {1}).positions(0, {0, 0, 0}).field(0, "density", {0}).make();
  EXPECT_THAT(values(between(first, second, 0.25), "density"), ElementsAre(6));
}

TEST(Fields, ThatOnlyOneSnapshotHasAreLeftOutAndNamed) {
  const auto first =
      MovingSnapshot(0).ids(0, {1}).positions(0, {0, 0, 0}).field(0, "density", {8}).make();
  const auto second = MovingSnapshot(1).ids(0, {1}).positions(0, {0, 0, 0}).make();
  const InterpolatedSnapshot middle = between(first, second, 0.25);
  EXPECT_EQ(find_field(middle.info().types[0], "density"), nullptr);
  EXPECT_THAT(middle.info().notes, Contains(HasSubstr("density")));
}

}  // namespace
}  // namespace splotchcl::test
