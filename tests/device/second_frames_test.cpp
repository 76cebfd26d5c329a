// What a frame of the same data costs once there was one (docs/dev/performance.md, "Films").
#include <gtest/gtest.h>

#include <cstdint>

#include "device/cloud_frames.h"
#include "device/stages.h"

namespace splotchcl::test {
namespace {

void draw(DeviceContext& device, ParticleStore& particles, const Frame& frame) {
  const FramePlan plan = make_plan(frame);
  particles.begin_frame();
  {
    Pipeline pipeline(device, particles, frame, plan);
    pipeline.draw();
    pipeline.collected();
  }
  particles.end_frame();
}

// After a first one, which makes them all, and a second, before which what lies idle may have to
// go.
std::uint64_t buffers_made_by_third_frame(const Frame& frame, bool rows) {
  DeviceContext device(choose_device(""));
  choose_shape(device.traits, rows);
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
