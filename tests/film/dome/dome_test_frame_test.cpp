// The geometry of domes, by their test frame.
#include "film/dome/dome_test_frame.h"

#include "scene/constants.h"
#include "testing.h"

namespace splotchcl {
namespace {

constexpr int size = 1024;
constexpr double degrees = 180 / pi;

Camera dome(double field_of_view = 180) {
  Camera camera;
  camera.position = {{0, 0, 0}};
  camera.look_at = {{0, 0, 10}};
  camera.sky = {{0, 1, 0}};
  camera.projection = Projection::fisheye;
  camera.field_of_view_degrees = field_of_view;
  camera.dome_tilt_degrees = 15;
  return camera;
}

bool is_red(const float* pixel) {
  return pixel[0] > 0.5F && pixel[1] < 0.3F && pixel[2] < 0.3F;
}
bool is_green(const float* pixel) {
  return pixel[1] > 0.3F && pixel[0] < 0.3F && pixel[2] < 0.3F;
}
bool is_blue(const float* pixel) {
  return pixel[2] > 0.5F && pixel[0] < 0.3F;
}
float brightness(const float* pixel) {
  return pixel[0] + pixel[1] + pixel[2];
}

TEST(DomeTestFrame, HasTheFrontAtTheBottomAndTheAudiencesRightToTheRight) {
  const Image image = draw_dome_test_frame(dome(), size, size);
  constexpr int middle = size / 2, edge = size / 5 + 3;
  EXPECT_TRUE(is_red(image.at(middle, size - edge)));
  EXPECT_TRUE(is_green(image.at(size - edge, middle)));
  EXPECT_TRUE(is_blue(image.at(edge, middle)));
  EXPECT_FALSE(is_red(image.at(middle, edge)));
}

// Rings lie at equal distances, up to the rim, which touches the picture's edges.
TEST(DomeTestFrame, HasRingsOfAltitudeWhereTheFisheyeHasThem) {
  const Image image = draw_dome_test_frame(dome(), size, size);
  const double angle = 20 / degrees;  // beside lines of azimuth and words
  const auto at = [&](double altitude) {
    const double radius = 0.5 * size * (90 - altitude) / 90;
    return image.at(static_cast<int>(0.5 * size + radius * std::sin(angle + pi / 180 * 5)),
                    static_cast<int>(0.5 * size + radius * std::cos(angle + pi / 180 * 5)));
  };
  for (const double ring : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    EXPECT_GT(brightness(at(ring)), 0.5F) << ring;
    EXPECT_LT(brightness(at(ring + 2.5)), 0.05F) << ring;
  }
  EXPECT_GT(brightness(at(0.3)), 0.5F);
  EXPECT_EQ(brightness(image.at(3, 3)), 0);
}

// The cross is where the film shows what it looks at.
TEST(DomeTestFrame, MarksTheLookAtPointSoFarAboveTheRimAsItIsTilted) {
  const Camera camera = dome();
  const CameraFrame frame = make_camera_frame(camera, size, size);
  const double y = 0.5 * size * (1 + (90 - 15) / 90.0);
  const DomePlace place = dome_place_at(0.5 * size, y, frame);
  EXPECT_NEAR(place.altitude, 15, 1e-9);
  EXPECT_NEAR(std::remainder(place.azimuth, 360), 0, 1e-9);
  const Image image = draw_dome_test_frame(camera, size, size);
  const float* const cross = image.at(size / 2 + 10, static_cast<int>(y));
  EXPECT_GT(cross[0], 0.5F);
  EXPECT_GT(cross[1], 0.5F);
  EXPECT_LT(cross[2], 0.3F);
}

TEST(DomeTestFrame, OfAWiderDomeHasItsRimWithin) {
  const CameraFrame frame = make_camera_frame(dome(220), size, size);
  EXPECT_NEAR(dome_place_at(0.5 * size, size, frame).altitude, -20, 1e-9);
  const Image image = draw_dome_test_frame(dome(220), size, size);
  EXPECT_TRUE(
      is_red(image.at(static_cast<int>(0.5 * size * (1 + 90 / 110.0 * std::sin(20 / degrees))),
                      static_cast<int>(0.5 * size * (1 + 90 / 110.0 * std::cos(20 / degrees))))));
}

}  // namespace
}  // namespace splotchcl
