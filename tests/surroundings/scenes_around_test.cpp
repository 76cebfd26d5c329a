// Random small scenes with clouds around the camera keep their tolerance, in all plans, shapes and
// projections.
#include "device/pictures.h"
#include "frames/random_frames.h"
#include "frames/random_promise.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class ScenesAround : public RandomPromise {
 protected:
  const RandomKind kind_ = {[](std::uint64_t seed) { return AroundSceneMaker(seed).make(); }};
};

TEST_F(ScenesAround, KeepTheirTolerance) {
  expect_tolerance_kept(kind_, seeds(1, 160, 13));
}

// In ordered pictures in which none of them is narrow.
TEST_F(ScenesAround, KeepTheirToleranceInLists) {
  constexpr double wide_enough = 48;  // twelve sigma away four pixels
  int in_lists = 0;
  for (const std::uint64_t seed : seeds(5001, 5140)) {
    const Frame frame = AroundSceneMaker(seed, 200).make();
    if (choose_light(frame) != LightPlan::ordered || frame.camera.focal_pixels < wide_enough)
      continue;
    ++in_lists;
    const ReferenceImage exact = reference::render(frame);
    for (const CompositeShape shape : {CompositeShape::rows, CompositeShape::groups}) {
      EXPECT_LE(largest_error(draw(frame, shape), exact), frame.tolerance)
          << "seed " << seed << ": " << describe(frame);
    }
  }
  EXPECT_GT(in_lists, 3);
}

TEST_F(ScenesAround, KeepThePromiseOfToleranceZero) {
  expect_tolerance_zero_kept(kind_, seeds(1001, 1060, 13));
}

TEST_F(ScenesAround, KeepTheirToleranceWithABound) {
  RendererOptions options;
  options.certify = true;
  Renderer renderer(options);
  for (const std::uint64_t seed : seeds(2001, 2020))
    expect_kept(kind_, kind_.make(seed), renderer, seed);
}

TEST_F(ScenesAround, KeepTheirToleranceInSlabs) {
  RendererOptions options;
  options.slabs = 2;
  options.shape = CompositeShape::rows;
  Renderer rows(options);
  options.shape = CompositeShape::groups;
  Renderer groups(options);
  PlanOptions plan_options;
  plan_options.slabs = options.slabs;
  int in_slabs = 0;
  for (const std::uint64_t seed : seeds(3001, 3100, 13)) {
    constexpr int large_enough_for_coarse_grids = 150;
    Frame frame = AroundSceneMaker(seed, large_enough_for_coarse_grids).make();
    frame.tolerance = std::max(frame.tolerance, 1e-3);
    for (DrawnComponent& component : frame.components)
      component.brightness *= 0.01;
    Renderer& renderer = seed % 2 == 0 ? rows : groups;
    EXPECT_LE(largest_error(renderer.render(frame), reference::render(frame)), frame.tolerance)
        << "seed " << seed << ": " << describe(frame);
    // What is not good enough is drawn again in order.
    in_slabs += make_plan(frame, plan_options).slabs > 0 &&
                renderer.stats().check.errors_of_promise.size() == 1;
  }
  EXPECT_GT(in_slabs, 0) << "some must be drawn in slabs";
}

// Narrow splats and wide ones between clouds that the camera stands in.
Frame among_clouds(double field_of_view, int count) {
  std::vector<Cloud> clouds;
  Random random(5);
  for (int i = 0; i < count; ++i) {
    clouds.push_back({0.02 * random.uniform(-1, 1), 0.02 * random.uniform(-1, 1),
                      0.05 + 0.4 * i / count,
                      i % 4 == 0   ? 0.1
                      : i % 4 == 1 ? 0.003
                                   : 0.0005,
                      0.16 / count});
  }
  WideCamera camera;
  camera.projection = Projection::perspective;
  camera.field_of_view = field_of_view;
  camera.width = camera.height = 64;
  DrawnComponent component = component_of(clouds, two_colors());
  component.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = wide_frame(camera, {component});
  frame.through_clouds = true;
  frame.tolerance = 1e-3;
  return frame;
}

// Draws in slabs, once, and says how much of the error allowed to slabs was used.
double expect_slabs_within_tolerance(const Frame& frame, CompositeShape shape) {
  const ReferenceImage exact = reference::render(frame);
  EXPECT_GT(largest_value(exact), 0.01);
  RendererOptions options;
  options.shape = shape;
  options.slabs = 3;
  Renderer renderer(options);
  EXPECT_LE(largest_error(renderer.render(frame), exact), frame.tolerance);
  EXPECT_EQ(renderer.stats().check.errors_of_promise.size(), 1U) << "drawn again";
  return renderer.stats().check.worst.slabs;
}

TEST_F(ScenesAround, LieInListsOfSlabs) {
  const Frame frame = among_clouds(40, 320);
  EXPECT_GT(expect_slabs_within_tolerance(frame, CompositeShape::rows), 0);
  EXPECT_GT(expect_slabs_within_tolerance(frame, CompositeShape::groups), 0);
}

// Some are narrower than lists can hold, which is four pixels. Then no splat is wide enough to be
// added up.
TEST_F(ScenesAround, EndSlabsAtTheirDepths) {
  const Frame frame = among_clouds(75, 40);
  expect_slabs_within_tolerance(frame, CompositeShape::rows);
  expect_slabs_within_tolerance(frame, CompositeShape::groups);
}

bool has_stage(const RenderStats& stats, const std::string& stage) {
  return std::any_of(stats.stages.begin(), stats.stages.end(),
                     [&](const StageTime& time) { return time.stage == stage; });
}

// Farther away than twelve sigma all clouds are splats, as without any.
TEST_F(ScenesAround, KeepTheirBitsWhereNoCloudIsNear) {
  for (const std::uint64_t seed : seeds(4001, 4040)) {
    Frame frame = AroundSceneMaker(seed).make();
    if (seed % 5 == 0) frame.tolerance = 0;
    for (DrawnComponent& component : frame.components) {
      Particles& particles = component.particles;
      std::vector<float> sizes(particles.count);
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        const float* place = particles.position.data() + 3 * i;
        const double distance =
            std::hypot(static_cast<double>(place[0]), static_cast<double>(place[1]),
                       static_cast<double>(place[2]));
        sizes[i] = static_cast<float>(distance / (12.01 * frame.kernel.width));
      }
      particles.smoothing_length = Column::owning(std::move(sizes));
    }
    const CompositeShape shape = seed % 2 == 0 ? CompositeShape::groups : CompositeShape::rows;
    const Image with = draw(frame, shape);
    EXPECT_FALSE(has_stage(renderer(shape).stats(), "surroundings"));
    frame.through_clouds = false;
    EXPECT_EQ(with.pixels, draw(frame, shape).pixels) << "seed " << seed << ": " << describe(frame);
  }
}

}  // namespace
}  // namespace splotchcl::test
