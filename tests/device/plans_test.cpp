// One frame drawn by different plans, shapes of compositing and tolerances.
#include "device/cases.h"
#include "device/pictures.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Frame clouds(const Absorption& absorption, double column = 1) {
  const CloudSetup setup = {500, 100, 70, 0.05, 30, 0.01 * column, column};
  DrawnComponent component = random_clouds(setup);
  component.absorption = absorption;
  return frame_of(setup.width, setup.height, {component});
}

// The same frame with an empty second component of another source: a plan made from structure alone
// can no longer see that one q serves all particles.
Frame with_empty_component(Frame frame) {
  DrawnComponent empty = frame.components.front();
  empty.particles = component_of({}, empty.palette).particles;
  empty.brightness *= 2;
  frame.components.push_back(empty);
  return frame;
}

class Plans : public PictureTest {
 protected:
  void expect_same_picture(const Frame& a, LightPlan plan_a, const Frame& b, LightPlan plan_b) {
    ASSERT_EQ(choose_light(a), plan_a);
    ASSERT_EQ(choose_light(b), plan_b);
    const Image picture_b = draw(b);
    EXPECT_GT(sum_of_light(picture_b), 10) << "there must be something to see";
    EXPECT_LE(largest_difference(draw(a), picture_b), 2 * a.tolerance);
  }
};

constexpr LightPlan emission = LightPlan::emission;
constexpr LightPlan proportional = LightPlan::proportional;
constexpr LightPlan ordered = LightPlan::ordered;

TEST_F(Plans, AgreeOnEqualEmissionAndAbsorption) {
  for (const double column : {0.1, 1.0, 30.0}) {
    const Frame equal = clouds({Absorption::Kind::as_emission, 0}, column);
    const Frame by_factor = with_empty_component(clouds({Absorption::Kind::factor, 1}, column));
    expect_same_picture(equal, proportional, by_factor, ordered);
  }
}

TEST_F(Plans, AgreeOnOneFactorForAllParticles) {
  for (const double factor : {0.2, 5.0}) {
    const Frame frame = clouds({Absorption::Kind::factor, factor});
    expect_same_picture(frame, proportional, with_empty_component(frame), ordered);
  }
}

TEST_F(Plans, AgreeOnAbsorptionTooFaintToMatter) {
  const Frame none = clouds({Absorption::Kind::none, 0});
  const Frame faint = clouds({Absorption::Kind::factor, 1e-9});
  expect_same_picture(none, emission, faint, proportional);
  expect_same_picture(none, emission, with_empty_component(faint), ordered);
}

// gray's source is e / (e + factor): with a factor of nothing it is E = A.
TEST_F(Plans, AgreeOnGrayAbsorptionThatReachesFullSources) {
  expect_same_picture(clouds({Absorption::Kind::as_emission, 0}), proportional,
                      clouds({Absorption::Kind::gray, 1e-12}), ordered);
}

TEST_F(Plans, AgreeOnAnAbsorptionPaletteThatIsTheEmissions) {
  const Frame equal = clouds({Absorption::Kind::as_emission, 0});
  Frame own_palette = equal;
  own_palette.components.front().palette.absorption = equal.components.front().palette.emission;
  expect_same_picture(equal, proportional, own_palette, ordered);
}

// What does not absorb cannot hide: any order of emitters is the same picture.
TEST_F(Plans, OrderEmittersWithoutEffect) {
  const Frame none = clouds({Absorption::Kind::none, 0});
  Frame beside_nothing = none;
  DrawnComponent absorber = none.components.front();
  absorber.particles = component_of({{1e6, 0, 1, 1, 1}}, absorber.palette).particles;
  absorber.absorption = {Absorption::Kind::gray, 1};
  beside_nothing.components.push_back(absorber);
  expect_same_picture(none, emission, beside_nothing, ordered);
}

TEST_F(Plans, GiveTheSamePictureInBothShapes) {
  for (const LightPlan plan : all_plans) {
    const Frame frame = clouds(absorption_for(plan));
    EXPECT_LE(
        largest_difference(draw(frame, CompositeShape::rows), draw(frame, CompositeShape::groups)),
        2 * frame.tolerance);
  }
}

TEST_F(Plans, KeepEveryTolerance) {
  for (const LightPlan plan : all_plans) {
    Frame frame = clouds(absorption_for(plan), 5);
    const ReferenceImage exact = reference::render(frame);
    for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-5}) {
      frame.tolerance = tolerance;
      EXPECT_LE(largest_error(draw(frame), exact), tolerance) << name(choose_light(frame));
    }
  }
}

// The way a pixel's mean is taken changes with the width, where depends on the tolerance.
TEST_F(Plans, KeepEveryToleranceForACloudOfAnyWidth) {
  for (const double sigma : {0.5, 1.2, 1.9, 2.8, 3.7, 4.6, 6.0, 9.0}) {
    const DrawnComponent cloud = component_of({{0.3, -1.7, 1, sigma, 4}}, two_colors());
    for (const LightPlan plan : all_plans) {
      Frame frame = frame_of(80, 60, {cloud});
      frame.components.front().absorption = absorption_for(plan);
      const ReferenceImage exact = reference::render(frame);
      for (const double tolerance : {1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5}) {
        frame.tolerance = tolerance;
        EXPECT_LE(largest_error(draw(frame), exact), tolerance)
            << name(choose_light(frame)) << ", sigma " << sigma;
      }
    }
  }
}

}  // namespace
}  // namespace splotchcl::test
