// Splats narrower than a pixel at tolerances at which the integers of their places would show
// (kernels/common/splat.h, place_fractions).
#include <gtest/gtest.h>

#include "device/cases.h"
#include "device/pictures.h"

namespace splotchcl::test {
namespace {

Frame narrow_clouds(LightPlan plan) {
  CloudSetup setup;
  setup.count = 1000;
  setup.width = 90;
  setup.height = 60;
  setup.sigma_low = 0.02;
  setup.sigma_high = 0.6;
  DrawnComponent component = random_clouds(setup);
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = frame_of(setup.width, setup.height, {component});
  frame.tolerance = 1e-5;
  return frame;
}

class FinePlaces : public PictureTest, public testing::WithParamInterface<CompositeShape> {};

TEST_P(FinePlaces, KeepThePromiseWithoutExtendedNumbers) {
  for (const LightPlan plan : all_plans) {
    const Frame frame = narrow_clouds(plan);
    EXPECT_LE(largest_error(draw(frame, GetParam()), reference::render(frame)), frame.tolerance)
        << name(plan);
    EXPECT_FALSE(renderer(GetParam()).stats().drawn_most_exactly) << name(plan);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, FinePlaces,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const auto& shape) {
                           return shape.param == CompositeShape::rows ? "rows" : "groups";
                         });

}  // namespace
}  // namespace splotchcl::test
