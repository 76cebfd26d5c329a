// Thin layers where transmittances are carried (kernels/composite/opacity.cl).
#include <gtest/gtest.h>

#include "device/pictures.h"
#include "reference/frames.h"

namespace splotchcl::test {
namespace {

// Small clouds that absorb, among light that nothing absorbs: how bright that shines through is
// not known.
Frame clouds_and_light(double tolerance) {
  CloudSetup setup;
  setup.count = 4000;
  setup.sigma_low = 1;
  setup.sigma_high = 2;
  DrawnComponent clouds = random_clouds(setup);
  clouds.absorption = {Absorption::Kind::gray, 0.3};
  setup.seed = 2;
  setup.count = 100;
  DrawnComponent light = random_clouds(setup);
  light.absorption = {Absorption::Kind::none, 0};
  Frame frame = frame_of(setup.width, setup.height, {clouds, light});
  frame.tolerance = tolerance;
  return frame;
}

class ThinLayers : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Shapes, ThinLayers, testing::Bool(),
                         [](const auto& info) { return info.param ? "rows" : "groups"; });

// A difference of error functions may be below zero by its error, and an opacity below zero would
// be read as a transmittance.
TEST_P(ThinLayers, DoNotDarkenWhatTheirRoundingsTouch) {
  RendererOptions options;
  options.shape = GetParam() ? CompositeShape::rows : CompositeShape::groups;
  Renderer renderer(options);
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Frame frame = clouds_and_light(tolerance);
    ASSERT_TRUE(make_plan(frame).layers.keeps_transmittance);
    EXPECT_LE(largest_error(renderer.render(frame), reference::render(frame)), tolerance);
  }
}

}  // namespace
}  // namespace splotchcl::test
