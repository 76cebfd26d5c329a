#include "splotchcl/camera.h"

#include "scene/constants.h"
#include "testing.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Pixel {
  double x, y;
};

Pixel project(const CameraFrame& frame, const Vec3& point) {
  const Vec3 d = point - frame.position;
  const double scale = frame.focal_pixels / dot(d, frame.forward);
  return {frame.center_x + scale * dot(d, frame.right),
          frame.center_y + scale * dot(d, frame.down)};
}

// Looks along +z from the origin, with y upwards.
Camera simple_camera() {
  Camera camera;
  camera.position = {{0, 0, 0}};
  camera.look_at = {{0, 0, 10}};
  camera.sky = {{0, 1, 0}};
  camera.field_of_view_degrees = 90;
  return camera;
}

std::string message_for(const Camera& camera) {
  return test::refusal_by<UsageError>([&] { make_camera_frame(camera, 100, 100); });
}

class RandomCameras : public ::testing::Test {
 protected:
  Vec3 random_vector(double size) {
    std::uniform_real_distribution<double> part(-size, size);
    return {{part(random_), part(random_), part(random_)}};
  }
  Camera random_camera() {
    Camera camera;
    camera.position = random_vector(1e5);
    camera.look_at = random_vector(1e5);
    camera.sky = random_vector(1);
    camera.field_of_view_degrees = std::uniform_real_distribution<double>(1, 170)(random_);
    return camera;
  }

 private:
  std::mt19937 random_{20080612};
};

TEST_F(RandomCameras, HaveOrthonormalRightHandedAxes) {
  for (int i = 0; i < 1000; ++i) {
    const CameraFrame frame = make_camera_frame(random_camera(), 640, 480);
    EXPECT_NEAR(mag(frame.right), 1, 1e-14);
    EXPECT_NEAR(mag(frame.down), 1, 1e-14);
    EXPECT_NEAR(mag(frame.forward), 1, 1e-14);
    // x right, y down, z forward: x cross y is z. Equal to the third axis, the
    // product of two unit vectors also says that they are perpendicular.
    EXPECT_NEAR(mag(cross(frame.right, frame.down) - frame.forward), 0, 1e-14);
  }
}

TEST_F(RandomCameras, ShowTheLookAtPointInTheMiddleOfThePicture) {
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = random_camera();
    const Pixel pixel = project(make_camera_frame(camera, 640, 480), camera.look_at);
    EXPECT_NEAR(pixel.x, 320, 1e-6);
    EXPECT_NEAR(pixel.y, 240, 1e-6);
  }
}

TEST_F(RandomCameras, ShowTheSkyDirectionStraightUpwards) {
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = random_camera();
    const CameraFrame frame = make_camera_frame(camera, 640, 480);
    const Pixel pixel = project(frame, camera.look_at + camera.sky * 1.0);
    EXPECT_NEAR(pixel.x, 320, 1e-6);
    EXPECT_LT(pixel.y, 240);
  }
}

TEST(Camera, HasViewCrossSkyOnTheRight) {
  const CameraFrame frame = make_camera_frame(simple_camera(), 100, 100);
  // z cross y is -x.
  EXPECT_NEAR(mag(frame.right - Vec3{{-1, 0, 0}}), 0, 1e-15);
  EXPECT_NEAR(mag(frame.down - Vec3{{0, -1, 0}}), 0, 1e-15);
  EXPECT_NEAR(mag(frame.forward - Vec3{{0, 0, 1}}), 0, 1e-15);
}

TEST(Camera, SeesHalfTheFieldOfViewOnEitherSide) {
  Camera camera = simple_camera();
  for (const double degrees : {1.0, 30.0, 90.0, 170.0}) {
    camera.field_of_view_degrees = degrees;
    const CameraFrame frame = make_camera_frame(camera, 640, 480);
    const double side = 10 * std::tan(degrees / 2 * pi / 180);
    EXPECT_NEAR(project(frame, {{-side, 0, 10}}).x, 640, 1e-9);
    EXPECT_NEAR(project(frame, {{side, 0, 10}}).x, 0, 1e-9);
  }
}

TEST(Camera, ShowsItsWidthAtTheLookAtDistance) {
  Camera camera = simple_camera();
  camera.width = 6;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    camera.projection = projection;
    EXPECT_NEAR(make_camera_frame(camera, 640, 480).pixels_per_length, 640 / 6.0, 1e-9);
  }
}

TEST(Camera, RefusesAWidthInWideAngles) {
  Camera camera = simple_camera();
  camera.width = 6;
  camera.projection = Projection::fisheye;
  EXPECT_THROW(make_camera_frame(camera, 640, 480), UsageError);
}

TEST(Camera, HasTheSameScaleVerticallyAsHorizontally) {
  const CameraFrame frame = make_camera_frame(simple_camera(), 640, 480);
  const double right = project(frame, {{-1, 0, 10}}).x - frame.center_x;
  const double up = frame.center_y - project(frame, {{0, 1, 10}}).y;
  EXPECT_NEAR(right, up, 1e-12);
}

TEST(Camera, HasTheOrthographicScaleOfTheLookAtDistance) {
  const CameraFrame frame = make_camera_frame(simple_camera(), 640, 480);
  const double perspective_pixels = project(frame, {{-1, 0, 10}}).x - frame.center_x;
  EXPECT_NEAR(frame.pixels_per_length, perspective_pixels, 1e-12);
}

TEST(Camera, TakesAnySkyThatIsNotParallelToTheView) {
  Camera tilted = simple_camera();
  tilted.sky = {{0, 1, 57}};
  EXPECT_NEAR(mag(make_camera_frame(tilted, 9, 9).down - Vec3{{0, -1, 0}}), 0, 1e-14);
}

TEST(Camera, TakesASkyOfAnyLength) {
  for (const double length : {1e-310, 1e-200, 1.0, 1e200, 1e308}) {
    Camera camera = simple_camera();
    camera.sky = {{0, length, length}};
    EXPECT_NEAR(mag(make_camera_frame(camera, 9, 9).down - Vec3{{0, -1, 0}}), 0, 1e-14) << length;
  }
}

TEST(Camera, RefusesAFieldOfViewThatShowsNothingOrEverything) {
  for (const double degrees : {0.0, -30.0, 180.0, 360.0, not_a_number}) {
    Camera camera = simple_camera();
    camera.field_of_view_degrees = degrees;
    EXPECT_THAT(message_for(camera), HasSubstr("camera.field_of_view: found")) << degrees;
  }
}

TEST(Camera, RefusesToStandAtItsLookAtPoint) {
  Camera camera = simple_camera();
  camera.look_at = camera.position;
  EXPECT_THAT(message_for(camera), HasSubstr("camera.look_at: found the camera's own position"));
}

TEST(Camera, RefusesALookAtPointBeyondArithmetic) {
  Camera camera = simple_camera();
  camera.look_at = {{0, 0, 1e200}};
  EXPECT_THAT(message_for(camera), HasSubstr("camera.look_at: found"));
}

TEST(Camera, RefusesASkyParallelToTheView) {
  for (const double z : {1.0, -1.0, 1e-5, 1e5}) {
    Camera camera = simple_camera();
    camera.sky = {{0, 0, z}};
    EXPECT_THAT(message_for(camera), HasSubstr("camera.sky: found")) << z;
  }
}

TEST(Camera, RefusesASkyOfZeros) {
  Camera camera = simple_camera();
  camera.sky = {{0, 0, 0}};
  EXPECT_THAT(message_for(camera), HasSubstr("no direction"));
}

TEST(Camera, RefusesVectorsThatAreNotFinite) {
  for (const double bad : {not_a_number, std::numeric_limits<double>::infinity()}) {
    Camera position = simple_camera(), look_at = simple_camera(), sky = simple_camera();
    position.position.a[1] = bad;
    look_at.look_at.a[0] = bad;
    sky.sky.a[2] = bad;
    EXPECT_THAT(message_for(position), HasSubstr("camera.position: found"));
    EXPECT_THAT(message_for(look_at), HasSubstr("camera.look_at: found"));
    EXPECT_THAT(message_for(sky), HasSubstr("camera.sky: found"));
  }
}

TEST(Camera, RefusesANearLimitBehindTheFarLimit) {
  Camera camera = simple_camera();
  camera.near_limit = 2;
  camera.far_limit = 1;
  EXPECT_THAT(message_for(camera), HasSubstr("camera.near: found 2, expected less than"));
  camera.far_limit = 2;
  EXPECT_THAT(message_for(camera), HasSubstr("camera.near: found 2, expected less than"));
}

TEST(Camera, ShowsSmallNumbersInItsMessages) {
  Camera camera = simple_camera();
  camera.sky = {{0, 0, 1e-12}};
  EXPECT_THAT(message_for(camera), HasSubstr("(0, 0, 1e-12)"));
}

Camera dome_camera(double tilt) {
  Camera camera = simple_camera();
  camera.projection = Projection::fisheye;
  camera.field_of_view_degrees = 180;
  camera.dome_tilt_degrees = tilt;
  return camera;
}

TEST(Dome, HasItsFrontAtTheBottomAndTheSkyInTheMiddle) {
  const CameraFrame frame = make_camera_frame(dome_camera(0), 100, 100);
  EXPECT_NEAR(mag(frame.forward - Vec3{{0, 1, 0}}), 0, 1e-12);
  EXPECT_NEAR(mag(frame.down - Vec3{{0, 0, 1}}), 0, 1e-12);
  EXPECT_NEAR(mag(cross(frame.right, frame.down) - frame.forward), 0, 1e-12);
}

TEST(Dome, ShowsTheLookAtPointSoFarAboveItsRim) {
  for (const double tilt : {-10.0, 0.0, 30.0, 90.0}) {
    const CameraFrame frame = make_camera_frame(dome_camera(tilt), 100, 100);
    const Vec3 ahead = {{0, 0, 1}};
    const double from_zenith = std::acos(dot(frame.forward, ahead)) * 180 / pi;
    EXPECT_NEAR(from_zenith, 90 - tilt, 1e-9);
    EXPECT_GE(dot(frame.down, ahead), -1e-12);
    EXPECT_NEAR(dot(frame.right, ahead), 0, 1e-12);
  }
}

TEST(Dome, IsAFisheye) {
  Camera camera = dome_camera(10);
  camera.projection = Projection::perspective;
  camera.field_of_view_degrees = 60;
  EXPECT_THAT([&] { make_camera_frame(camera, 100, 100); },
              ThrowsMessage<UsageError>(HasSubstr("camera.dome_tilt")));
}

}  // namespace
}  // namespace splotchcl
