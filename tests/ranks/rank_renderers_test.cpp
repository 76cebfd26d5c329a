#include <mutex>

#include "device/scenes.h"
#include "ranks/mpi_library.h"
#include "ranks/thread_ranks.h"
#include "splotchcl/renderer.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Renderers of several ranks: what is decided while a frame is drawn is decided alike.

struct Rendered {
  Image image;
  RenderStats stats;
};

Rendered render_alone(const Frame& frame) {
  Renderer renderer;
  return {renderer.render(frame), renderer.stats()};
}

std::vector<Rendered> render_together(const Frame& frame, int ranks) {
  std::vector<Rendered> rendered(static_cast<std::size_t>(ranks));
  ThreadRanks::run(ranks, [&](Communicator& all) {
    RendererOptions options;
    options.ranks = std::shared_ptr<Communicator>(std::shared_ptr<Communicator>(), &all);
    Renderer renderer(options);
    Rendered& own = rendered[static_cast<std::size_t>(all.rank())];
    own.image = renderer.render(frame);
    own.stats = renderer.stats();
  });
  return rendered;
}

Frame crowd(double tolerance, Absorption absorption) {
  CloudSetup setup;
  setup.count = 20000;
  setup.sigma_high = 4;
  setup.column_high = 0.2;
  DrawnComponent clouds = random_clouds(setup);
  clouds.absorption = absorption;
  Frame frame = frame_of(setup.width, setup.height, {clouds});
  frame.tolerance = tolerance;
  return frame;
}

void expect_same(const Frame& frame) {
  const Rendered alone = render_alone(frame);
  for (const Rendered& one : render_together(frame, 2)) {
    EXPECT_EQ(one.image.pixels, alone.image.pixels);
    EXPECT_EQ(one.stats.check.errors_of_promise, alone.stats.check.errors_of_promise);
    EXPECT_EQ(one.stats.check.blocks.errors, alone.stats.check.blocks.errors);
    EXPECT_EQ(one.stats.drawn_particles, alone.stats.drawn_particles);
    EXPECT_EQ(one.stats.drawn_most_exactly, alone.stats.drawn_most_exactly);
  }
}

TEST(RankRenderers, HaveThePictureEverywhere) {
  expect_same(crowd(1e-3, {Absorption::Kind::gray, 0.2}));
  expect_same(crowd(1e-3, {Absorption::Kind::none, 0}));
}

TEST(RankRenderers, DrawAgainTogether) {
  Frame frame = crowd(1e-5, {Absorption::Kind::gray, 0.2});
  // Far brighter than a plan expects that tries nothing.
  for (DrawnComponent& component : frame.components)
    component.brightness *= 1000;
  const FramePlan plan = make_plan(frame);
  Renderer alone;
  const Image image = alone.render(frame, plan);
  const std::vector<double> errors = alone.stats().check.errors_of_promise;
  EXPECT_GT(errors.size(), 1u);
  ThreadRanks::run(2, [&](Communicator& all) {
    RendererOptions options;
    options.ranks = std::shared_ptr<Communicator>(std::shared_ptr<Communicator>(), &all);
    Renderer renderer(options);
    EXPECT_EQ(renderer.render(frame, plan).pixels, image.pixels);
    EXPECT_EQ(renderer.stats().check.errors_of_promise, errors);
  });
}

TEST(RankRenderers, TryPartsTogether) {
  Frame frame = crowd(1e-5, {Absorption::Kind::gray, 0.2});
  for (DrawnComponent& component : frame.components)
    component.brightness *= 1000;
  ASSERT_FALSE(Renderer::first_plan(frame, {}).tried_parts.empty());
  expect_same(frame);
}

TEST(RankRenderers, ProjectAllParticlesOnceTogetherForOneDrawing) {
  Frame frame = crowd(1e-3, {Absorption::Kind::gray, 0.2});
  for (DrawnComponent& component : frame.components)
    component.brightness *= 0.01;
  for (const Rendered& one : render_together(frame, 3)) {
    ASSERT_EQ(one.stats.check.errors_of_promise.size(), 1u);
    std::uint64_t particles = 0;
    for (const ProcessStats& process : one.stats.processes)
      particles += process.particles;
    EXPECT_EQ(particles, one.stats.particles);
  }
}

TEST(RankRenderers, TellWhatEachHasDone) {
  const std::vector<Rendered> rendered =
      render_together(crowd(1e-3, {Absorption::Kind::gray, 0.2}), 3);
  for (const Rendered& one : rendered) {
    ASSERT_EQ(one.stats.processes.size(), 3u);
    std::uint64_t particles = 0, splats = 0;
    for (const ProcessStats& process : one.stats.processes) {
      particles += process.particles;
      splats += process.splats;
      EXPECT_GT(process.sent_bytes, 0u);
      EXPECT_GT(process.seconds, 0);
    }
    const std::uint64_t drawings = one.stats.check.errors_of_promise.size();
    // Parts that are drawn again take all particles, too.
    EXPECT_GE(particles, drawings * one.stats.particles);
    EXPECT_EQ(particles % one.stats.particles, 0u);
    EXPECT_GE(splats, one.stats.drawn_particles);
    EXPECT_EQ(one.stats.processes[2].host, "host2");
  }
}

TEST(SharedHost, SharesOutItsCores) {
  EXPECT_EQ(cores_of_rank(16, 16, 4), 4);
  EXPECT_EQ(cores_of_rank(16, 16, 3), 5);
  EXPECT_EQ(cores_of_rank(2, 2, 4), 1);
}

TEST(SharedHost, LeavesARankTheCoresThatItIsBoundTo) {
  EXPECT_EQ(cores_of_rank(16, 4, 4), 4);
  EXPECT_EQ(cores_of_rank(16, 1, 4), 1);
}

}  // namespace
}  // namespace splotchcl::test
