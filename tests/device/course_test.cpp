#include "device/cloud_frames.h"
#include "device/pictures.h"
#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Who waits for a picture is told how far it is, and may end it.

// Where nothing absorbs, the device takes one component after the other.
Frame frame_of_components(int count) {
  std::vector<DrawnComponent> components;
  for (int i = 0; i < count; ++i) {
    components.push_back(random_clouds({60, 40, 30}));
    components.back().absorption = {Absorption::Kind::none, 0};
  }
  return frame_of(40, 30, components);
}

TEST(Progress, GrowsFromPartToPart) {
  std::vector<double> told;
  RendererOptions options;
  options.progress = [&told](double fraction) { told.push_back(fraction); };
  Renderer(options).render(frame_of_components(4));
  // The frame may be drawn again.
  ASSERT_GE(told.size(), 4U);
  told.resize(4);
  EXPECT_THAT(told, ElementsAre(0, 0.25, 0.5, 0.75));
}

TEST(Progress, IsNotToldOfOnePart) {
  int calls = 0;
  RendererOptions options;
  options.progress = [&calls](double) { ++calls; };
  Renderer(options).render(frame_of_components(1));
  EXPECT_EQ(calls, 0);
}

TEST(Progress, EndsADrawingByWhatItThrows) {
  bool is_enough = true;
  RendererOptions options;
  options.progress = [&is_enough](double fraction) {
    if (is_enough && fraction > 0.3) throw std::runtime_error("enough");
  };
  Renderer renderer(options);
  const Frame frame = frame_of_components(4);
  EXPECT_THROW(renderer.render(frame), std::runtime_error);
  is_enough = false;
  EXPECT_EQ(renderer.render(frame).pixels, Renderer().render(frame).pixels);
}

// The parts of a frame that more cores do not shorten.

class SerialTimes : public PictureTest {
 protected:
  // Enough for several groups of work-items in every kernel that walks particles or pixels.
  static std::vector<std::string> parts_of(const Absorption& absorption) {
    Random random(5);
    std::vector<Cloud> clouds;
    for (int i = 0; i < 20000; ++i) {
      clouds.push_back({random.uniform(-90, 90), random.uniform(-60, 60), random.uniform(1, 100),
                        random.logarithmic(0.1, 2), random.logarithmic(1e-3, 1e-1)});
    }
    DrawnComponent component = component_of(clouds, two_colors());
    component.absorption = absorption;
    draw(frame_of(180, 120, {component}), CompositeShape::rows);
    std::vector<std::string> parts;
    for (const StageTime& part : renderer(CompositeShape::rows).stats().serial)
      parts.push_back(part.stage);
    return parts;
  }
};

TEST_F(SerialTimes, NameEachPartOnce) {
  const std::vector<std::string> parts = parts_of({Absorption::Kind::gray, 0.2});
  EXPECT_EQ(std::set<std::string>(parts.begin(), parts.end()).size(), parts.size());
}

TEST_F(SerialTimes, HaveTheHostTheCheckAndCopies) {
  EXPECT_THAT(parts_of({Absorption::Kind::none, 0}),
              testing::IsSupersetOf({"host", "check", "copies"}));
}

TEST_F(SerialTimes, HaveTheScansOfASort) {
  EXPECT_THAT(parts_of({Absorption::Kind::gray, 0.2}), Contains("sort"));
}

TEST_F(SerialTimes, HaveNothingOfStagesThatAllCoresShare) {
  EXPECT_THAT(parts_of({Absorption::Kind::none, 0}), Not(Contains("resolve")));
}

// What a frame of the same data costs once there was one (docs/dev/performance.md, "Films").

void draw(DeviceContext& device, ParticleStore& particles, const Frame& frame) {
  const FramePlan plan = make_plan(frame);
  const std::uint64_t number = particles.begin_frame();
  {
    Pipeline pipeline(device, particles, frame, plan);
    pipeline.draw();
    pipeline.collected();
  }
  particles.end_frame(number);
}

// After a first one, which makes them all, and a second, before which what lies idle may have to
// go.
std::uint64_t buffers_made_by_third_frame(const Frame& frame, bool rows) {
  DeviceContext device(choose_device(""));
  device.traits.choose_shape(rows);
  ParticleStore particles(device);
  draw(device, particles, frame);
  draw(device, particles, frame);
  const std::uint64_t before = device.pool.buffers_made();
  EXPECT_GT(before, 0u);
  draw(device, particles, frame);
  return device.pool.buffers_made() - before;
}

// The camera stands in clouds, which takes memory of its own after all else has been drawn.
Frame ordered_frame() {
  return within_clouds(400, 300);
}

Frame sum_of_clouds() {
  return with_absorption(ordered_frame(), {Absorption::Kind::as_emission, 0});
}

Frame with_cut_kernel(Frame frame) {
  frame.kernel.cut = 1.8;
  return frame;
}

TEST(SecondFrames, OfSumsMakeNoBuffers) {
  for (const bool rows : {true, false}) {
    EXPECT_EQ(buffers_made_by_third_frame(sum_of_clouds(), rows), 0u);
    EXPECT_EQ(buffers_made_by_third_frame(with_cut_kernel(sum_of_clouds()), rows), 0u);
  }
}

TEST(SecondFrames, InOrderMakeNoBuffers) {
  for (const bool rows : {true, false}) {
    EXPECT_EQ(buffers_made_by_third_frame(ordered_frame(), rows), 0u);
    EXPECT_EQ(buffers_made_by_third_frame(with_cut_kernel(ordered_frame()), rows), 0u);
  }
}

}  // namespace
}  // namespace splotchcl::test
