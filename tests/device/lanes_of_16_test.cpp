// Patches of sixteen columns and sixteen particles at a time (kernels/composite/patches.cl,
// kernels/common/lanes.cl), on processors of any width.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

// Drawn with the frame's first plan.
Image draw_in_lanes_of(int pixels, const Frame& frame) {
  DeviceContext device(choose_device(""));
  device.traits.rows_of_16 = pixels == 16;
  return draw_once(device, frame, CompositeShape::rows);
}

Frame clouds(LightPlan plan, std::optional<double> cut, Projection projection) {
  CloudSetup setup;
  setup.count = 300;
  setup.width = 130;
  setup.height = 65;
  setup.sigma_low = 0.5;
  setup.column_low = 1e-3;
  DrawnComponent component = random_clouds(setup);
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.2};
  Frame frame = frame_of(setup.width, setup.height, {component});
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

void expect_same_bits(const Frame& frame, const std::string& what) {
  EXPECT_EQ(draw_in_lanes_of(16, frame).pixels, draw_in_lanes_of(8, frame).pixels) << what;
}

TEST(LanesOfSixteen, GiveTheBitsOfLanesOfEight) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    expect_same_bits(clouds(plan, std::nullopt, Projection::orthographic), name(plan));
    expect_same_bits(clouds(plan, 1.8, Projection::orthographic),
                     name(plan) + std::string(", cut"));
    expect_same_bits(clouds(plan, 1.8, Projection::equirectangular),
                     name(plan) + std::string(", cut ellipses"));
  }
}

}  // namespace
}  // namespace splotchcl::test
