// The device's pictures against the oracle's, in every plan and both shapes of
// compositing, within the tolerance that the frame promises.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "device/cases.h"
#include "device/scenes.h"
#include "splotchcl/plan.h"

namespace splotchcl::test {
namespace {

void set_light(DrawnComponent& component, LightPlan light) {
  if (light == LightPlan::emission) component.absorption.kind = Absorption::Kind::none;
  if (light == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.2};
}

class Agreement : public testing::TestWithParam<PlanAndShape> {
 protected:
  LightPlan light() const { return std::get<0>(GetParam()); }
  Image draw(const Frame& frame) const {
    RendererOptions options;
    options.shape = std::get<1>(GetParam());
    Renderer renderer(options);
    return renderer.render(frame);
  }
  Frame frame_for(CloudSetup setup) const {
    DrawnComponent component = random_clouds(setup);
    set_light(component, light());
    Frame frame = frame_of(setup.width, setup.height, {component});
    EXPECT_EQ(choose_light(frame), light());
    return frame;
  }
  void expect_within_tolerance(const Frame& frame) const {
    const ReferenceImage exact = reference::render(frame);
    EXPECT_GT(largest_value(exact), 0.05) << "the scene must have something to see";
    const double error = largest_error(draw(frame), exact);
    RecordProperty("error", std::to_string(error));
    EXPECT_LE(error, frame.tolerance);
  }
};

TEST_P(Agreement, HoldsForCloudsOfAllSizes) {
  expect_within_tolerance(frame_for({}));
}

TEST_P(Agreement, HoldsForGrainsBelowAPixel) {
  CloudSetup setup;
  setup.count = 3000;
  setup.sigma_low = 0.01;
  setup.sigma_high = 1;
  expect_within_tolerance(frame_for(setup));
}

TEST_P(Agreement, HoldsForWideThinClouds) {
  CloudSetup setup;
  setup.count = 3000;
  setup.sigma_low = 5;
  setup.sigma_high = 80;
  setup.column_low = 1e-4;
  setup.column_high = 1e-2;
  expect_within_tolerance(frame_for(setup));
}

TEST_P(Agreement, HoldsForOpaqueClouds) {
  CloudSetup setup;
  setup.count = 300;
  setup.column_low = 1;
  setup.column_high = 100;
  expect_within_tolerance(frame_for(setup));
}

TEST_P(Agreement, HoldsOnABackground) {
  Frame frame = frame_for({});
  frame.background = {0.2, 0.5, 0.9};
  expect_within_tolerance(frame);
}

TEST_P(Agreement, HoldsForCenterSamplesOfAnUncutKernel) {
  CloudSetup setup;
  setup.sigma_low = 0.5;
  Frame frame = frame_for(setup);
  frame.kernel.sampling = Sampling::center;
  expect_within_tolerance(frame);
}

TEST_P(Agreement, HoldsForLooseAndTightTolerances) {
  for (const double tolerance : {1e-2, 1e-4, 1e-5}) {
    CloudSetup setup;
    setup.count = 2000;
    setup.sigma_low = 0.5;
    setup.column_low = 1e-3;
    setup.column_high = 1e-1;
    Frame frame = frame_for(setup);
    frame.tolerance = tolerance;
    expect_within_tolerance(frame);
  }
}

TEST_P(Agreement, HoldsForPicturesOfAwkwardSizes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 131}, {97, 1}, {33, 17}, {32, 16}}) {
    CloudSetup setup;
    setup.width = width;
    setup.height = height;
    setup.column_low = 0.1;
    expect_within_tolerance(frame_for(setup));
  }
}

TEST_P(Agreement, SameFrameGivesTheSameBits) {
  const Frame frame = frame_for({});
  EXPECT_EQ(draw(frame).pixels, draw(frame).pixels);
}

INSTANTIATE_TEST_SUITE_P(Plans, Agreement, each_plan_and_shape(), name_of_case);

}  // namespace
}  // namespace splotchcl::test
