// What lies under the pointer.
#include "view/pick.h"

#include <gtest/gtest.h>

#include "splotchcl/camera.h"

namespace splotchcl::view {
namespace {

// Looks along z from 10 before the origin; a picture of 100 x 100 pixels.
Frame frame_with(const std::vector<float>& positions, const std::vector<float>& masses) {
  Frame frame;
  frame.width = frame.height = 100;
  Camera camera;
  camera.position = {{0, 0, -10}};
  camera.look_at = {{0, 0, 0}};
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  DrawnComponent component;
  component.particles.count = masses.size();
  component.particles.position = Column::owning(positions);
  component.particles.smoothing_length = Column::uniform(0.1f);
  component.particles.weight = Column::owning(masses);
  frame.components.push_back(component);
  return frame;
}

TEST(Pick, FindsTheParticleUnderThePointer) {
  const auto found = pick_particle(frame_with({0, 0, 0, 3, 0, 0}, {1, 1}), 50, 50);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->a[0], 0);
}

TEST(Pick, FindsNothingInTheDark) {
  EXPECT_FALSE(pick_particle(frame_with({0, 0, 0}, {1}), 10, 10));
}

TEST(Pick, TakesTheMiddleOfTheLightByDepth) {
  const Frame frame = frame_with({0, 0, 8, 0, 0, 0, 0, 0, 4}, {1, 1, 1});
  EXPECT_EQ(pick_particle(frame, 50, 50)->a[2], 4);
}

TEST(Pick, TakesWhatIsBright) {
  const Frame frame = frame_with({0, 0, 8, 0, 0, 0, 0, 0, 4}, {1, 100, 1});
  EXPECT_EQ(pick_particle(frame, 50, 50)->a[2], 0);
}

TEST(Pick, LeavesOutWhatIsBehindTheCamera) {
  EXPECT_FALSE(pick_particle(frame_with({0, 0, -20}, {1}), 50, 50));
}

}  // namespace
}  // namespace splotchcl::view
