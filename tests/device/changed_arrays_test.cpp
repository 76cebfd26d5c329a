// What a renderer has drawn before does not show in what it draws next.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "device/frame/particle_store.h"
#include "device/pictures.h"
#include "device/pipeline.h"

namespace splotchcl::test {
namespace {

class ChangedArrays : public PictureTest, public testing::WithParamInterface<bool> {
 protected:
  // As renderers do, frame by frame.
  static Image draw_next(DeviceContext& device, ParticleStore& store, const Frame& frame) {
    store.begin_frame();
    const FramePlan plan = make_plan(frame);
    Image image = Pipeline(device, store, frame, plan).draw();
    device.queue.finish();
    store.end_frame();
    return image;
  }
};

INSTANTIATE_TEST_SUITE_P(Memory, ChangedArrays, testing::Bool(), [](const auto& info) {
  return info.param ? "of_the_host" : "of_the_device";
});

TEST_P(ChangedArrays, AreDrawnAsTheyAreNow) {
  DeviceContext device(choose_device(""));
  device.traits.shares_host_memory &= GetParam();
  ParticleStore store(device);
  std::vector<float> places(3 * 100, 0.5f);
  Frame frame = frame_of(16, 12, {component_of(std::vector<Cloud>(100, Cloud{}), two_colors())});
  frame.components.front().particles.position = Column(nullptr, places.data(), places.size());
  EXPECT_GT(sum_of_light(draw_next(device, store, frame)), 0);
  for (float& place : places)
    place = 1e6f;
  EXPECT_EQ(sum_of_light(draw_next(device, store, frame)), 0);
}

TEST(ParticleStore, KeepsNoBufferOfAValueThatNoFrameAsksFor) {
  DeviceContext device(choose_device(""));
  ParticleStore store(device);
  Particles particles;
  particles.count = 1;
  const auto draw_with = [&](float weight) {
    store.begin_frame();
    particles.weight = Column::uniform(weight);
    const compute::buffer buffer = store.get(particles, {0, 0, 1}).weight;
    store.end_frame();
    return buffer;
  };
  const compute::buffer first = draw_with(5);
  EXPECT_EQ(draw_with(5), first);
  const auto users = first.reference_count();
  draw_with(6);
  EXPECT_EQ(first.reference_count(), users - 1);
}

TEST_F(PictureTest, AfterValuesThatAreNoNumbersIsAsBefore) {
  Frame frame = frame_of(16, 12, {component_of(std::vector<Cloud>(100, Cloud{}), two_colors())});
  const Image before = draw(frame);
  Frame bad = frame;
  bad.components.front().particles.weight =
      Column::uniform(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(sum_of_light(draw(bad)), 0);
  EXPECT_EQ(renderer().stats().bad_particles, 100u);
  EXPECT_EQ(draw(frame).pixels, before.pixels);
}

}  // namespace
}  // namespace splotchcl::test
