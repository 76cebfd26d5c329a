// Patches of sixteen columns and sixteen particles at a time (kernels/composite/patches.cl,
// kernels/common/lanes.cl), on processors of any width.
#include <gtest/gtest.h>

#include <optional>

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

// Of cut splats the same ones wait for each other.
TEST(LanesOfSixteen, GiveTheBitsOfLanesOfEightWhereSplatsAreCut) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    for (const Projection projection : {Projection::orthographic, Projection::equirectangular}) {
      const Frame frame = clouds(plan, 1.8, projection);
      EXPECT_EQ(draw_in_lanes_of(16, frame).pixels, draw_in_lanes_of(8, frame).pixels)
          << name(plan) << ", projection " << static_cast<int>(projection);
    }
  }
}

// Others are added up in another order: each of 300 splats may be rounded in another way.
TEST(LanesOfSixteen, GiveTheLightOfLanesOfEight) {
  constexpr double roundings = 300 * 0x1p-24;
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    const Frame frame = clouds(plan, std::nullopt, Projection::orthographic);
    EXPECT_LT(largest_difference(draw_in_lanes_of(16, frame), draw_in_lanes_of(8, frame)),
              roundings)
        << name(plan);
  }
}

}  // namespace
}  // namespace splotchcl::test
