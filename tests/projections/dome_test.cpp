// The fisheye picture of a dome against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "projections/wide_frames.h"
#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

constexpr double degree = pi / 180;

// Where the camera sees a point at this angle from its view direction, turned by `around`.
Cloud at_angle(double angle, double around, double distance = 3) {
  return cloud_towards(
      {{std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)}},
      distance, 0.01);
}

// All directions lead there; those of its digits are roundings.
TEST(Dome, PutsWhatIsRightBehindTheCameraToTheRight) {
  const WideCamera camera = {Projection::fisheye, 300, 200, 360};
  for (const double around : {0.0, 0.7, 3.0}) {
    const reference::Splat splat =
        only_splat(wide_frame(camera, {white_light({at_angle(180 * degree, around)})}));
    EXPECT_NEAR(splat.x, 250, 1e-9);
    EXPECT_NEAR(splat.y, 100, 1e-9);
  }
}

TEST(Dome, RadiusIsLinearInTheAngle) {
  for (const double field_of_view : {60.0, 180.0, 240.0, 360.0}) {
    const WideCamera camera = {Projection::fisheye, 300, 200, field_of_view};
    for (const double part : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      if (field_of_view * part == 360) continue;  // right behind the camera
      const double angle = part * 0.5 * field_of_view * degree;
      const reference::Splat splat =
          only_splat(wide_frame(camera, {white_light({at_angle(angle, 0.7)})}));
      // Positions are stored in single precision.
      EXPECT_NEAR(splat.x, 150 + 100 * part * std::cos(0.7), 1e-3);
      EXPECT_NEAR(splat.y, 100 + 100 * part * std::sin(0.7), 1e-3);
    }
  }
}

TEST(Dome, DepthIsTheDistance) {
  const Frame frame = wide_frame({}, {white_light({at_angle(1.5, 0, 5), at_angle(0, 0, 6)})});
  const auto splats = reference::project(frame);
  ASSERT_EQ(splats.size(), 2u);
  EXPECT_LT(splats[0].key, splats[1].key) << "the nearer one, though its z is larger";
}

TEST(Dome, LimitsAreDistances) {
  Frame frame = wide_frame({}, {white_light({at_angle(1.5, 0, 5), at_angle(2.5, 0, 7)})});
  frame.near_limit = 4;
  frame.far_limit = 6;
  EXPECT_EQ(reference::project(frame).size(), 1u);
}

TEST(Dome, IsDarkOutsideItsCircle) {
  Frame frame = wide_frame({Projection::fisheye, 90, 60, 180.0}, {even_sky(500, 0.1)});
  frame.background = {0.5, 0.5, 0.5};
  const ReferenceImage image = reference::render(frame);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 90; ++x) {
      const bool inside = std::hypot(x + 0.5 - 45, y + 0.5 - 30) <= 30;
      EXPECT_EQ(red_of(image, x, y) > 0, inside) << x << ", " << y;
    }
  }
}

// Within what neighbouring clouds leave uneven, and what flat splats on a curved sky err.
TEST(Dome, ShowsAnEvenSkyEvenly) {
  const ReferenceImage image =
      reference::render(wide_frame({Projection::fisheye, 60, 60, 220.0}, {even_sky(8000, 0.05)}));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double radius = std::hypot(x + 0.5 - 30, y + 0.5 - 30);
      if (radius >= 30) continue;
      EXPECT_NEAR(red_of(image, x, y), 1, 0.03) << x << ", " << y;
    }
  }
}

TEST(Dome, TakesAnyAngleUpTo360Degrees) {
  for (const double bad : {0.0, -10.0, 361.0, std::nan("")}) {
    EXPECT_THROW(wide_frame({Projection::fisheye, 10, 10, bad}, {}), UsageError) << bad;
  }
  EXPECT_NO_THROW(wide_frame({Projection::fisheye, 10, 10, 360.0}, {}));
}

}  // namespace
}  // namespace splotchcl::test
