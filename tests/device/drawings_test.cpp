#include <thread>

#include "device/pictures.h"
#include "device/stages.h"
#include "scene/constants.h"
#include "splotchcl/reference.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// How often frames are drawn until they keep their promise.

class Drawings : public PictureTest {
 protected:
  static std::size_t drawings_of(const Frame& frame) {
    draw(frame);
    return renderer().stats().check.errors_of_promise.size();
  }

  static Frame faint_discs_in_one_place(double tolerance) {
    const std::vector<Cloud> discs(400, Cloud{3.3, -7.1, 50, 9, 0.002});
    Frame frame = frame_of(100, 70, {component_of(discs, two_colors())});
    frame.kernel.cut = 1.8;
    frame.kernel.sampling = Sampling::center;
    frame.tolerance = tolerance;
    return frame;
  }

  static CloudSetup faint_clouds(int width, int height, double column_low, double column_high) {
    CloudSetup faint;
    faint.width = width;
    faint.height = height;
    faint.count = 2000;
    faint.sigma_high = 3;
    faint.column_low = column_low;
    faint.column_high = column_high;
    return faint;
  }

  // Around pixel 50, 50.
  static Frame crowd_among_faint_clouds(Absorption absorption) {
    const CloudSetup faint = faint_clouds(400, 300, 0.001, 0.02);
    const std::vector<Cloud> crowd(20000, Cloud{-150, -100, 50, 3, 0.5});
    Frame frame = frame_of(faint.width, faint.height,
                           {random_clouds(faint), component_of(crowd, one_color(1, 1, 1))});
    for (DrawnComponent& component : frame.components)
      component.absorption = absorption;
    return frame;
  }

  // In the first and in the last corner, of clouds with these columns.
  static Frame two_crowds(double first, double last) {
    const CloudSetup faint = faint_clouds(600, 450, 1e-5, 2e-4);
    const std::vector<Cloud> before(300, Cloud{-225, -175, 50, 4.5, first});
    const std::vector<Cloud> behind(300, Cloud{225, 175, 50, 4.5, last});
    return frame_of(faint.width, faint.height,
                    {random_clouds(faint), component_of(before, one_color(1, 1, 1)),
                     component_of(behind, one_color(1, 1, 1))});
  }

  // Wide clouds in the middle, whose ends add up around them.
  static Frame cluster_in_the_dark(double tolerance) {
    CloudSetup setup;
    setup.width = 100;
    setup.height = 70;
    setup.count = 4000;
    setup.sigma_low = 8;
    setup.sigma_high = 12;
    setup.column_low = 0.01;
    setup.column_high = 0.3;
    Frame frame = frame_of(400, 300, {random_clouds(setup)});
    frame.components[0].absorption = {Absorption::Kind::gray, 0.2};
    frame.tolerance = tolerance;
    return frame;
  }

  // Of more particles than are all looked at before it is drawn.
  static Frame many_in_a_small_place(double light) {
    CloudSetup setup;
    setup.width = setup.height = 40;
    setup.count = 70000;
    setup.sigma_low = 2;
    setup.sigma_high = 5;
    setup.column_low = setup.column_high = light;
    Frame frame = frame_of(400, 300, {random_clouds(setup)});
    frame.components[0].absorption = {Absorption::Kind::gray, 0.2};
    return frame;
  }

  // Haloes of all sizes, denser and of narrower clouds towards their middles, more than are all
  // looked at before they are drawn; brightness over four decades, and any kind of absorption.
  static Frame random_haloes(std::uint64_t seed) {
    Random random(seed);
    std::vector<Cloud> clouds;
    while (clouds.size() < 70000) {
      const double x = random.uniform(-120, 120), y = random.uniform(-90, 90);
      const double size = random.logarithmic(2, 60);
      for (double left = random.logarithmic(100, 20000); left > 0; --left) {
        const double r = size * std::pow(random.uniform(), 2), angle = random.uniform(0, 2 * pi);
        clouds.push_back({x + r * std::cos(angle), y + r * std::sin(angle), random.uniform(1, 100),
                          0.1 * size + 0.3 * r, 1});
      }
    }
    const double column = random.logarithmic(1e-3, 10);
    for (Cloud& cloud : clouds)
      cloud.column = column / cloud.sigma;
    Frame frame = frame_of(240, 180, {component_of(clouds, two_colors())});
    frame.tolerance = random.logarithmic(1e-4, 1e-2);
    Absorption& absorption = frame.components[0].absorption;
    const double kind = random.uniform(0, 6);
    if (kind < 1) absorption.kind = Absorption::Kind::none;
    if (kind >= 2) absorption = {Absorption::Kind::gray, random.logarithmic(0.03, 10)};
    return frame;
  }

  // How many of the pixels from the first column on differ, and of those before it.
  static std::pair<int, int> differences(const Image& a, const Image& b, int first) {
    int beyond = 0, before = 0;
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x)
        (x < first ? before : beyond) += !std::equal(a.at(x, y), a.at(x, y) + 4, b.at(x, y));
    }
    return {beyond, before};
  }
};

// The edges of discs that lie upon one another have no coarse grid that is good enough.
TEST_F(Drawings, OfCutKernelsNeedNoSecondOne) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    EXPECT_EQ(drawings_of(faint_discs_in_one_place(tolerance)), 1U) << tolerance;
}

// By one renderer in several threads, of frames that are drawn again.
TEST_F(Drawings, AreTheSameWhereThoseOfOtherFramesComeBetween) {
  std::vector<Frame> frames;
  for (const double tolerance : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5})
    frames.push_back(cluster_in_the_dark(tolerance));
  std::vector<Image> images(frames.size());
  std::vector<RenderStats> stats(frames.size());
  std::vector<std::thread> threads;
  Renderer shared;
  for (std::size_t i = 0; i < frames.size(); ++i)
    threads.emplace_back(
        [&, i] { images[i] = shared.render(frames[i], make_plan(frames[i]), stats[i]); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    RenderStats alone;
    const Image expected = renderer().render(frames[i], make_plan(frames[i]), alone);
    EXPECT_GT(alone.check.errors_of_promise.size(), 1U) << i;
    EXPECT_EQ(images[i].pixels, expected.pixels) << i;
    EXPECT_EQ(stats[i].check.errors_of_promise, alone.check.errors_of_promise) << i;
    EXPECT_EQ(stats[i].tile_entries, alone.tile_entries) << i;
  }
}

TEST_F(Drawings, AreOneWhereAPartIsTried) {
  const Frame frame = many_in_a_small_place(0.01);
  EXPECT_EQ(drawings_of(frame), 1U);
  FramePlan untried = Renderer::first_plan(frame, {});
  EXPECT_FALSE(untried.tried_parts.empty());
  untried.tried_parts.clear();
  renderer().render(frame, untried);
  EXPECT_GT(renderer().stats().check.errors_of_promise.size(), 1U) << "a plan that tries nothing";
}

TEST_F(Drawings, AreOneOfMostRandomHaloes) {
  constexpr std::uint64_t frames = 20;
  std::uint64_t drawn_once = 0;
  for (std::uint64_t seed = 1; seed <= frames; ++seed) {
    Frame frame = random_haloes(seed);
    drawn_once += drawings_of(frame) == 1;
    frame.crop = {110, 80, 12, 12};
    EXPECT_LE(largest_error(draw(frame), reference::render(frame)), frame.tolerance) << seed;
  }
  EXPECT_GE(drawn_once, frames * 9 / 10);
}

// Splats above white stay on the picture's own grid up to a larger width than others, or on finer
// ones: that is where they are expected to lie upon one another.
TEST_F(Drawings, OfBrightCrowdsAreOneWhereTheirGridIsKnownBefore) {
  EXPECT_EQ(drawings_of(two_crowds(2, 2)), 1U);
}

// Whichever part is drawn last.
TEST_F(Drawings, OfPartsTellOfTheWorstOfAllBlocks) {
  for (const bool is_first_brighter : {false, true}) {
    const Frame frame = is_first_brighter ? two_crowds(20, 2) : two_crowds(2, 20);
    renderer().render(frame, make_plan(frame));
    const FrameCheck& check = renderer().stats().check;
    EXPECT_NEAR(check.worst.sum(), check.errors_of_promise.back(),
                1e-5 * check.errors_of_promise.back());
  }
}

TEST_F(Drawings, AfterTheFirstAreOfThePartsThatBrokeThePromise) {
  DeviceContext device(choose_device(""));
  for (const Absorption& absorption : {Absorption{}, Absorption{Absorption::Kind::gray, 0.2}}) {
    const Frame frame = crowd_among_faint_clouds(absorption);
    const Image image = renderer().render(frame, make_plan(frame));
    const std::vector<double>& errors = renderer().stats().check.errors_of_promise;
    ASSERT_GT(errors.size(), 1U);
    EXPECT_GT(errors.front(), 1);
    EXPECT_LE(errors.back(), 1);
    const Image first = draw_once(device, frame, CompositeShape::rows);
    const auto [far_away, around_the_crowd] = differences(image, first, 200);
    EXPECT_EQ(far_away, 0);
    EXPECT_GT(around_the_crowd, 0);
    EXPECT_LE(largest_difference(image, reference::render(frame).to_float()), frame.tolerance);
  }
}

// What the check after drawing is made from: all splats that were drawn, each once.

double sum_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class CertifierTest : public StageTest, public testing::WithParamInterface<LightPlan> {
 protected:
  // Columns of all clouds are alike, and so are their peaks from sigma 1 on.
  static Frame clouds(double sigma_low, double sigma_high) {
    CloudSetup setup;
    setup.count = 500;
    setup.width = 150;
    setup.height = 110;
    setup.sigma_low = sigma_low;
    setup.sigma_high = sigma_high;
    setup.column_low = setup.column_high = 0.01;
    DrawnComponent component = random_clouds(setup);
    component.palette = one_color(1, 1, 1);
    if (GetParam() == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
    if (GetParam() == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 1e6};
    return frame_of(setup.width, setup.height, {component});
  }

  // What counts of a cloud's column of 0.01: absorption as so much of emission, of which gray
  // absorption leaves nothing.
  static double counted_peak(const Frame& frame) { return 0.01 * make_plan(frame).light_behind; }

  std::vector<PeakCells> collected(const Frame& frame, std::uint64_t& drawn) {
    ParticleStore particles(device());
    const FramePlan plan = make_plan(frame);
    Pipeline pipeline(device(), particles, frame, plan);
    pipeline.draw();
    drawn = pipeline.counts().visible;
    return pipeline.collected().cells;
  }
};

TEST_P(CertifierTest, CollectsThePeakOfEachSplatOnce) {
  std::uint64_t drawn = 0;
  double peaks = 0;
  const Frame frame = clouds(4, 12);
  for (const PeakCells& cells : collected(frame, drawn))
    peaks += sum_of(cells.peaks.values);
  // Center values are widened by 1 / 6 in the square of sigma. What blurred grids make brighter is
  // taken back as for the widest splats of an octave: up to as much again is left.
  ASSERT_GT(drawn, 300);
  const double expected = counted_peak(frame) * static_cast<double>(drawn);
  EXPECT_GE(peaks, 0.98 * expected);
  EXPECT_LE(peaks, 2 * expected);
}

TEST_P(CertifierTest, TellsOctavesOfWidthsApart) {
  std::uint64_t drawn = 0;
  for (const PeakCells& cells : collected(clouds(4.1, 7.9), drawn))
    EXPECT_EQ(cells.octave, 3);
}

TEST_P(CertifierTest, CountsNoMoreOfAnEndThanWhereABrightSplatEnds) {
  Frame frame = clouds(1.1, 1.8);
  frame.components[0].brightness = 1e4;
  std::uint64_t drawn = 0;
  const FramePlan plan = make_plan(frame);
  const float least = plan.splats.least_extent;
  const double edge =
      std::exp(static_cast<double>(least * least)) / static_cast<double>(plan.splats.inverse_edge);
  // They may count among wider splats that end as far, in the measure of these.
  double farther = plan.needs.widths[1].farther;
  for (std::size_t octave = 1; octave < plan.needs.widths.size(); ++octave)
    farther = std::max(farther, plan.needs.widths[octave].farther);
  const double measure = std::exp(farther - plan.needs.widths[1].farther);
  for (const PeakCells& cells : collected(frame, drawn)) {
    EXPECT_LE(sum_of(cells.endings.values), 1.0001 * measure * edge * static_cast<double>(drawn));
    EXPECT_GT(sum_of(cells.endings.values), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, CertifierTest,
                         testing::Values(LightPlan::emission, LightPlan::proportional,
                                         LightPlan::ordered),
                         [](const auto& info) { return std::string(name(info.param)); });

TEST(FrameCheckTest, DrawsFaintCloudsOnce) {
  CloudSetup setup;
  setup.column_low = 0.001;
  setup.column_high = 0.02;
  Renderer renderer;
  renderer.render(frame_of(setup.width, setup.height, {random_clouds(setup)}));
  EXPECT_EQ(renderer.stats().check.errors_of_promise.size(), 1U);
  EXPECT_LE(renderer.stats().check.errors_of_promise.back(), 1);
}

Frame splats_in_one_place() {
  return frame_of(
      100, 70,
      {component_of(std::vector<Cloud>(20000, Cloud{0.3, 0.2, 1, 3, 0.5}), one_color(1, 1, 1))});
}

TEST(FrameCheckTest, DrawsAgainWhatManySplatsInOnePlaceLeaveOut) {
  const Frame frame = splats_in_one_place();
  Renderer renderer;
  const Image image = renderer.render(frame, make_plan(frame));
  EXPECT_GE(renderer.stats().check.errors_of_promise.size(), 2U);
  EXPECT_GT(renderer.stats().check.errors_of_promise.front(), 1);
  EXPECT_LE(renderer.stats().check.errors_of_promise.back(), 1);
  EXPECT_LE(largest_difference(image, reference::render(frame).to_float()), frame.tolerance);
}

TEST(FrameCheckTest, DrawsAtOnceWhatASampleExpectsOfManySplatsInOnePlace) {
  const Frame frame = splats_in_one_place();
  Renderer renderer;
  const Image image = renderer.render(frame);
  EXPECT_EQ(renderer.stats().check.errors_of_promise.size(), 1U);
  EXPECT_LE(largest_difference(image, reference::render(frame).to_float()), frame.tolerance);
}

TEST(FrameCheckTest, PromisesAtToleranceZeroWhatItsNumbersHold) {
  Frame frame = frame_of(100, 70, {random_clouds({})});
  frame.tolerance = 0;
  Renderer renderer;
  renderer.render(frame);
  EXPECT_EQ(renderer.stats().check.errors_of_promise, std::vector<double>{1});
  for (const float error : renderer.stats().check.blocks.errors)
    EXPECT_GE(error, extended_tolerance * 0.999999);
}

TEST(FrameCheckTest, IsABoundWhereThatIsAskedFor) {
  RendererOptions options;
  options.certify = true;
  Renderer renderer(options);
  const Frame frame = frame_of(100, 70, {random_clouds({})});
  const Image image = renderer.render(frame);
  EXPECT_TRUE(renderer.stats().check.is_bound);
  EXPECT_LE(renderer.stats().check.errors_of_promise.back(), 1);
  EXPECT_LE(largest_difference(image, reference::render(frame).to_float()), frame.tolerance);
}

}  // namespace
}  // namespace splotchcl::test
