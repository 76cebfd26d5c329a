// Every kernel in every variant that frames may ask for, on scenes so small that also a
// simulator ends them soon (scripts/test --icd oclgrind).
#include "device/cases.h"
#include "device/pictures.h"
#include "splotchcl/error.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class EveryKernel : public PictureTest, public testing::WithParamInterface<CompositeShape> {
 protected:
  // Clouds from far below a pixel to wider than the picture, so that sums use coarse grids.
  static Frame small_frame(LightPlan plan, int count = 12) {
    return clouds_for(plan, {count, 35, 14, 0.05, 30, 0.1});
  }

  // The camera among the clouds looks in all directions.
  static Frame wide_frame(Projection projection, int count = 12) {
    Frame frame = small_frame(LightPlan::ordered, count);
    Camera camera;
    camera.look_at = {{0, 0, 1}};
    camera.projection = projection;
    if (projection == Projection::cube) frame.width = frame.height;
    if (projection == Projection::equirectangular) frame.height = frame.width / 2;
    frame.crop = {0, 0, frame.width, frame.height};
    frame.camera = make_camera_frame(camera, frame.width, frame.height);
    frame.projection = projection;
    return frame;
  }

  void expect_within_tolerance(const Frame& frame, const std::string& what) {
    const double promise = frame.tolerance > 0 ? frame.tolerance : extended_tolerance;
    EXPECT_LE(largest_error(draw(frame, GetParam()), reference::render(frame)), promise)
        << what << ", " << name(choose_light(frame));
  }
};

TEST_P(EveryKernel, HoldsItsTolerance) {
  for (const LightPlan plan : all_plans) {
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 0.0}) {
      Frame frame = small_frame(plan, tolerance > 0 ? 12 : 4);
      frame.tolerance = tolerance;
      expect_within_tolerance(frame, "tolerance " + std::to_string(tolerance));
    }
  }
}

TEST_P(EveryKernel, HoldsItsToleranceWithoutDoublePrecisionOrSaysThatItNeedsIt) {
  Renderer without({"", GetParam(), false});
  Frame frame = small_frame(LightPlan::ordered, 3);
  frame.tolerance = 1e-5;
  EXPECT_LE(largest_error(without.render(frame), reference::render(frame)), 1e-5);
  frame.tolerance = 0;
  EXPECT_THAT([&] { without.render(frame); },
              testing::ThrowsMessage<DeviceError>(testing::HasSubstr("no double precision")));
}

TEST_P(EveryKernel, NeedsDoublePrecisionForSharpSplatsInWideAngles) {
  Renderer without({"", GetParam(), false});
  Frame frame = wide_frame(Projection::fisheye);
  frame.tolerance = 1e-4;
  const std::vector<Cloud> sharp = {{0.3, 0.1, 1, 1e-5, 1e-5}};
  frame.components.front() = component_of(sharp, two_colors());
  EXPECT_THROW(without.render(frame), DeviceError);
  expect_within_tolerance(frame, "sharp");
}

// Clouds so dim that the wide ones are added up in slabs and laid among the narrow ones.
TEST_P(EveryKernel, LaysSlabs) {
  Frame frame = small_frame(LightPlan::ordered);
  for (DrawnComponent& component : frame.components)
    component.brightness = 0.02;
  frame.tolerance = 1e-3;
  RendererOptions options;
  options.shape = GetParam();
  options.slabs = 2;
  Renderer renderer(options);
  EXPECT_LE(largest_error(renderer.render(frame), reference::render(frame)), frame.tolerance);
  EXPECT_EQ(renderer.stats().check.errors_of_promise.size(), 1U) << "drawn again in order";
  EXPECT_GT(renderer.stats().check.worst.slabs, 0);
}

// Light of stars beside them and behind them: their shapes and transmittances keep all digits.
TEST_P(EveryKernel, DrawsBrightStars) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    Frame frame = small_frame(plan);
    DrawnComponent stars = component_of({{3.3, 1.2, 200, 1.7, 1e4}}, two_colors());
    stars.absorption = {Absorption::Kind::none, 0};
    frame.components.push_back(stars);
    // Narrow clouds before them, whose tails the polynomials of 1e-4 draw a little negative.
    std::vector<Cloud> gas;
    for (int i = 0; i < 12; ++i)
      gas.push_back({3.3 * i - 16, 0.37 * i - 2, 1, 0.4 + 0.1 * i, 0.02});
    frame.components.push_back(component_of(gas, two_colors()));
    if (plan == LightPlan::emission)
      frame.components.back().absorption.kind = Absorption::Kind::none;
    for (const double tolerance : {1e-3, 1e-4}) {
      frame.tolerance = tolerance;
      expect_within_tolerance(frame, "stars");
    }
  }
}

TEST_P(EveryKernel, CutsKernels) {
  for (const LightPlan plan : all_plans) {
    for (const Sampling sampling : {Sampling::mean, Sampling::center}) {
      Frame frame = small_frame(plan);
      frame.kernel.cut = 2;
      frame.kernel.sampling = sampling;
      expect_within_tolerance(frame, "cut");
    }
  }
}

TEST_P(EveryKernel, TakesColorsOfTheParticlesOwn) {
  for (const LightPlan plan : all_plans) {
    Frame frame = small_frame(plan);
    Particles& particles = frame.components.front().particles;
    std::vector<float> vectors(3 * particles.count);
    for (std::size_t i = 0; i < vectors.size(); ++i)
      vectors[i] = static_cast<float>(i % 5) / 5;
    particles.color_vector = Column::owning(vectors);
    expect_within_tolerance(frame, "vectors");
  }
}

TEST_P(EveryKernel, PutsAPictureBehind) {
  Frame frame = small_frame(LightPlan::ordered);
  Image image(frame.width, frame.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i % 7) / 7;
  frame.background_image = std::make_shared<const Image>(image);
  expect_within_tolerance(frame, "background");
}

TEST_P(EveryKernel, LooksInAllDirections) {
  for (const Projection projection :
       {Projection::fisheye, Projection::equirectangular, Projection::cube}) {
    Frame frame = wide_frame(projection);
    expect_within_tolerance(frame, "wide angle");
    frame.camera.eye_offset = 0.01;
    frame.camera.turn_axis = {{0, 1, 0}};
    expect_within_tolerance(frame, "an eye beside the camera");
  }
}

// Wide ones in lists, narrow ones as layers of their own; the thick and bright ones keep all
// digits.
TEST_P(EveryKernel, LooksThroughCloudsAroundTheCamera) {
  for (const Projection projection : {Projection::perspective, Projection::equirectangular}) {
    for (const double field_of_view : {25.0, 150.0}) {
      Frame frame = wide_frame(projection);
      Camera camera;
      camera.look_at = {{0, 0, 1}};
      camera.projection = projection;
      camera.field_of_view_degrees = field_of_view;
      frame.camera = make_camera_frame(camera, frame.width, frame.height);
      frame.through_clouds = true;
      DrawnComponent around = component_of(
          {{0, 0, 0.5, 1, 0.2}, {0.3, -0.1, 5, 0.8, 3}, {0, 0.1, -1, 1, 9}}, two_colors());
      around.absorption = {Absorption::Kind::gray, 0.3};
      frame.components.push_back(around);
      for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        frame.tolerance = tolerance;
        expect_within_tolerance(frame, "around, " + std::to_string(field_of_view));
      }
    }
  }
}

TEST_P(EveryKernel, LooksInAllDirectionsAtToleranceZero) {
  std::vector<Projection> projections = {Projection::equirectangular};
  // Kernels made for GPUs take a processor's compiler seconds each.
  if (GetParam() == CompositeShape::rows || long_tests())
    projections.insert(projections.end(), {Projection::fisheye, Projection::cube});
  for (const Projection projection : projections) {
    Frame frame = wide_frame(projection, 4);
    frame.tolerance = 0;
    expect_within_tolerance(frame, "wide angle");
    frame.camera.eye_offset = 0.01;
    frame.camera.turn_axis = {{0, 1, 0}};
    expect_within_tolerance(frame, "an eye beside the camera");
  }
}

// A list that is cut: layers of its segments, and what the check is told of them, are joined.
TEST_P(EveryKernel, JoinsSegments) {
  const std::vector<Cloud> grains(100, Cloud{0.2, 0.3, 1, 0.1, 0.01});
  DeviceContext device(choose_device(""));
  device.traits.choose_shape(GetParam() == CompositeShape::rows);
  device.traits.segment_length = 30;
  for (const double tolerance : {1e-3, 0.0}) {
    Frame frame = frame_of(3, 2, {component_of(grains, two_colors())});
    frame.components.front().absorption = {Absorption::Kind::gray, 0.2};
    frame.tolerance = tolerance;
    EXPECT_LE(largest_error(draw_once(device, frame, GetParam()), reference::render(frame)),
              tolerance > 0 ? tolerance : extended_tolerance);
  }
}

// Room for four splats at a time, of which each window leaves some to the next one.
TEST_P(EveryKernel, DrawsInWindows) {
  DeviceContext device(choose_device(""));
  device.traits.choose_shape(GetParam() == CompositeShape::rows);
  device.traits.sorted_chunk = 5;
  for (const double tolerance : {1e-3, 0.0}) {
    Frame frame = small_frame(LightPlan::ordered, 12);
    frame.tolerance = tolerance;
    frame.sort.by = tolerance > 0 ? SortOrder::By::depth : SortOrder::By::field;
    device.memory.total = ~std::uint64_t{0};
    const Image whole = draw_once(device, frame, GetParam());
    device.memory.total = 1;
    EXPECT_EQ(draw_once(device, frame, GetParam()).pixels, whole.pixels) << tolerance;
  }
}

// Particles of one depth: a stable sort by all bits of the keys.
TEST_P(EveryKernel, SortsManyEqualDepths) {
  const std::vector<Cloud> grains(50, Cloud{0.2, 0.3, 1, 0.1, 0.01});
  Frame frame = frame_of(3, 2, {component_of(grains, two_colors())});
  frame.components.push_back(component_of({{0.2, 0.3, 1e6, 0.1, 0.01}}, two_colors()));
  for (DrawnComponent& component : frame.components)
    component.absorption = {Absorption::Kind::gray, 0.2};
  expect_within_tolerance(frame, "equal depths");
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryKernel,
                         testing::Values(CompositeShape::rows, CompositeShape::groups),
                         [](const testing::TestParamInfo<CompositeShape>& info) {
                           return info.param == CompositeShape::rows ? "rows" : "groups";
                         });

}  // namespace
}  // namespace splotchcl::test
