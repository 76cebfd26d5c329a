// Rows of sixteen pixels (kernels/composite/wide_rows.cl), on processors of any width.
#include <gtest/gtest.h>

#include <optional>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

// Drawn with the frame's first plan.
Image draw_in_rows_of(int pixels, const Frame& frame) {
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

TEST(RowsOfSixteen, GiveTheBitsOfRowsOfEight) {
  for (const LightPlan plan : {LightPlan::emission, LightPlan::ordered}) {
    const Frame flat = clouds(plan, std::nullopt, Projection::orthographic);
    EXPECT_EQ(draw_in_rows_of(16, flat).pixels, draw_in_rows_of(8, flat).pixels) << name(plan);
    const Frame ellipses = clouds(plan, 1.8, Projection::equirectangular);
    EXPECT_EQ(draw_in_rows_of(16, ellipses).pixels, draw_in_rows_of(8, ellipses).pixels)
        << name(plan) << ", cut ellipses";
  }
}

}  // namespace
}  // namespace splotchcl::test
