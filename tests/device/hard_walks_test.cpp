#include "device/cases.h"
#include "device/pictures.h"
#include "reference/frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Patches of sixteen columns and sixteen particles at a time (kernels/composite/waiting.cl,
// kernels/common/lanes.cl), on processors of any width.

// Drawn with the frame's first plan.
Image draw_in_lanes_of(int pixels, const Frame& frame) {
  DeviceContext device(choose_device(""));
  device.traits.rows_of_16 = pixels == 16;
  return draw_once(device, frame, CompositeShape::rows);
}

Frame clouds(LightPlan plan, std::optional<double> cut, Projection projection) {
  Frame frame = clouds_for(plan, {300, 130, 65, 0.5, 30, 1e-3});
  frame.kernel.cut = cut;
  if (projection == Projection::equirectangular) {
    Camera camera;
    camera.look_at = {{0, 0, 1}};
    camera.projection = projection;
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    frame.projection = projection;
  }
  return frame;
}

constexpr Projection round_and_not[] = {Projection::orthographic, Projection::equirectangular};

// Of cut splats the same ones wait for each other.
TEST(LanesOfSixteen, GiveTheBitsOfLanesOfEightWhereSumsAreOfCutSplats) {
  for (const Projection projection : round_and_not) {
    const Frame frame = clouds(LightPlan::emission, 1.8, projection);
    EXPECT_EQ(draw_in_lanes_of(16, frame).pixels, draw_in_lanes_of(8, frame).pixels)
        << "projection " << static_cast<int>(projection);
  }
}

// Others are added up in another order: each of 300 splats may be rounded in another way.
TEST(LanesOfSixteen, GiveTheSumsOfLanesOfEight) {
  constexpr double roundings = 300 * 0x1p-24;
  const Frame frame = clouds(LightPlan::emission, std::nullopt, Projection::orthographic);
  EXPECT_LT(largest_difference(draw_in_lanes_of(16, frame), draw_in_lanes_of(8, frame)), roundings);
}

// Layers take as many terms of phi as they are deep in a patch, and patches are of other sizes.
// What is left out on either side is known.
TEST(LanesOfSixteen, GiveTheOrderedLightOfLanesOfEightUpToTheTermsThatAreLeftOut) {
  for (const std::optional<double> cut : {std::optional<double>(), std::optional<double>(1.8)}) {
    for (const Projection projection : round_and_not) {
      const Frame frame = clouds(LightPlan::ordered, cut, projection);
      EXPECT_LT(largest_difference(draw_in_lanes_of(16, frame), draw_in_lanes_of(8, frame)),
                2 * make_plan(frame).shares.phi)
          << "projection " << static_cast<int>(projection);
    }
  }
}

// Thin layers where transmittances are carried (kernels/composite/opacity.cl).

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

// Splats narrower than a pixel at tolerances at which the integers of their places would show
// (kernels/common/splat.h, place_fractions).

Frame narrow_clouds(LightPlan plan) {
  Frame frame = clouds_for(plan, {1000, 90, 60, 0.02, 0.6});
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

// Lists of one tile that are cut into many segments.

class LongLists : public PictureTest, public testing::WithParamInterface<PlanAndShape> {};

// 50000 clouds in one tile of either shape, several times the length of a segment.
TEST_P(LongLists, GiveTheOraclesPicture) {
  const auto [plan, shape] = GetParam();
  Random random(101);
  std::vector<Cloud> clouds;
  std::vector<float> colors;
  for (int i = 0; i < 50000; ++i) {
    clouds.push_back({random.uniform(-7, 7), random.uniform(-7, 7), random.uniform(1, 100),
                      random.logarithmic(0.1, 2), random.logarithmic(1e-3, 1e-1)});
    colors.push_back(static_cast<float>(random.uniform()));
  }
  DrawnComponent component = component_of(clouds, two_colors());
  component.particles.color = Column::owning(colors);
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.01};
  const Frame frame = frame_of(16, 16, {component});
  ASSERT_EQ(choose_light(frame), plan);
  const ReferenceImage exact = reference::render(frame);
  EXPECT_GT(largest_value(exact), 0.2);
  EXPECT_LE(largest_error(draw(frame, shape), exact), frame.tolerance);
  EXPECT_EQ(renderer(shape).stats().tile_entries, 50000u);
}

// Each rounds the sum alike: only sums of blocks keep them from adding up.
TEST_P(LongLists, GiveTheOraclesPictureOfEqualNarrowSplatsAtASmallTolerance) {
  const auto [plan, shape] = GetParam();
  constexpr int count = 16000;
  const std::vector<Cloud> clouds(count, Cloud{0.3, 0.2, 10, 0.4, 2.0 / count});
  DrawnComponent component = component_of(clouds, two_colors());
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.01};
  Frame frame = frame_of(16, 16, {component});
  frame.tolerance = 1.5e-6;
  ASSERT_FALSE(make_plan(frame).is_extended());
  EXPECT_LE(largest_error(draw(frame, shape), reference::render(frame)), frame.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Plans, LongLists, each_plan_and_shape(), name_of_case);

}  // namespace
}  // namespace splotchcl::test
