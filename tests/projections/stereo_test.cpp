// Two eyes against closed forms.
#include "splotchcl/stereo.h"

#include "projections/wide_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double look_at_distance = 10;
constexpr double angle_degrees = 3;
constexpr double step = angle_degrees * pi / 180 * look_at_distance;

struct Seen {
  reference::Splat left, right;
  double disparity() const { return left.x - right.x; }
};

Frame frame_for(Projection projection, const Vec3& point) {
  const int height = projection == Projection::equirectangular ? 200 : 400;
  return wide_frame({projection, 400, height, {}, look_at_distance},
                    {white_light({{point.a[0], point.a[1], point.a[2], 0.01}})});
}

Seen see(const Stereo& stereo, Projection projection, const Vec3& point) {
  const Frame frame = frame_for(projection, point);
  Seen seen;
  for (const Eye eye : {Eye::left, Eye::right}) {
    Frame view = frame;
    view.camera = eye_camera(frame.camera, projection, stereo, eye);
    (eye == Eye::left ? seen.left : seen.right) = only_splat(view);
  }
  return seen;
}

Stereo stereo_of(StereoMode mode, StereoEyes eyes = StereoEyes::right_shifted) {
  return {angle_degrees, mode, eyes, StereoLayout::files};
}

const StereoEyes both_eyes[] = {StereoEyes::right_shifted, StereoEyes::centered};

TEST(Stereo, OffAxisDisparityFollowsFromTheDistance) {
  for (const StereoEyes eyes : both_eyes) {
    for (const double z : {2.0, 5.0, 10.0, 20.0, 1000.0}) {
      const Seen seen =
          see(stereo_of(StereoMode::off_axis, eyes), Projection::perspective, {{0.5, 0.3, z}});
      const double focal = 200 / std::tan(22.5 * pi / 180);
      EXPECT_NEAR(seen.disparity(), focal * step * (1 / z - 1 / look_at_distance), 1e-4) << z;
      EXPECT_NEAR(seen.left.y, seen.right.y, 1e-9) << "no vertical parallax";
    }
  }
}

TEST(Stereo, ParallelDisparityVanishesAtInfinity) {
  for (const double z : {2.0, 10.0, 1e6}) {
    const Seen seen = see(stereo_of(StereoMode::parallel), Projection::perspective, {{0, 0, z}});
    const double focal = 200 / std::tan(22.5 * pi / 180);
    EXPECT_NEAR(seen.disparity(), focal * step / z, 1e-4);
  }
}

TEST(Stereo, LookAtPointHasNoDisparity) {
  const Vec3 look_at = {{0, 0, look_at_distance}};
  for (const StereoEyes eyes : both_eyes) {
    for (const Projection projection :
         {Projection::perspective, Projection::fisheye, Projection::equirectangular}) {
      const Seen seen = see(stereo_of(StereoMode::off_axis, eyes), projection, look_at);
      EXPECT_NEAR(seen.disparity(), 0, 1e-9);
    }
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
      const Seen seen = see(stereo_of(StereoMode::toe_in, eyes), projection, look_at);
      EXPECT_NEAR(seen.left.x, 200, 1e-9);
      EXPECT_NEAR(seen.right.x, 200, 1e-9);
    }
  }
}

TEST(Stereo, LeftEyeIsTheCameraUnlessCentered) {
  const Vec3 point = {{1, -2, 7}};
  const reference::Splat one = only_splat(frame_for(Projection::perspective, point));
  const Seen shifted = see(stereo_of(StereoMode::off_axis), Projection::perspective, point);
  EXPECT_EQ(shifted.left.x, one.x);
  const Seen centered =
      see(stereo_of(StereoMode::off_axis, StereoEyes::centered), Projection::perspective, point);
  EXPECT_NEAR(0.5 * (centered.left.x + centered.right.x), one.x, 1e-9);
}

TEST(Stereo, ToeInTurnsTheSecondCameraByTheAngle) {
  const Frame frame = frame_for(Projection::perspective, {{0, 0, 1}});
  const CameraFrame right =
      eye_camera(frame.camera, Projection::perspective, stereo_of(StereoMode::toe_in), Eye::right);
  // C = c + r beta |v| and a view to the same point.
  EXPECT_NEAR(right.position.a[0], step, 1e-12);
  EXPECT_NEAR(std::atan2(-right.forward.a[0], right.forward.a[2]),
              std::atan(angle_degrees * pi / 180), 1e-12);
  EXPECT_NEAR(right.forward.a[1], 0, 1e-12);
  EXPECT_NEAR(right.right.a[0] * right.forward.a[0] + right.right.a[2] * right.forward.a[2], 0,
              1e-12);
}

TEST(Stereo, PanoramaTurnsEveryDirectionByItsParallax) {
  for (const double longitude : {-3.0, -1.0, 0.0, 2.0}) {
    for (const double distance : {2.0, 10.0, 1000.0}) {
      const Vec3 point = {{distance * std::sin(longitude), 0, distance * std::cos(longitude)}};
      const Seen parallel =
          see(stereo_of(StereoMode::parallel), Projection::equirectangular, point);
      const double turned = parallel.disparity() / (200 / pi);
      EXPECT_NEAR(std::remainder(turned - std::asin(step / distance), 2 * pi), 0, 1e-5);
      const Seen converging =
          see(stereo_of(StereoMode::off_axis), Projection::equirectangular, point);
      const double left = converging.disparity() / (200 / pi);
      EXPECT_NEAR(
          std::remainder(left - std::asin(step / distance) + std::asin(step / look_at_distance),
                         2 * pi),
          0, 1e-5);
      EXPECT_NEAR(parallel.left.y, parallel.right.y, 1e-9) << "no vertical parallax";
    }
  }
}

// An eye at the tangent to the circle of the eyes: the exact ray, for points at eye level.
TEST(Stereo, PanoramaSeesAlongTangentsOfTheEyesCircle) {
  const Vec3 point = {{1.2, 0, -0.7}};
  const Seen seen = see(stereo_of(StereoMode::parallel), Projection::equirectangular, point);
  const double longitude = (seen.right.x - 200) * pi / 200;
  const Vec3 ahead = {{std::sin(longitude), 0, std::cos(longitude)}};
  const Vec3 to_the_right = {{std::cos(longitude), 0, -std::sin(longitude)}};
  // point = eye + t ahead with the eye at step * to_the_right.
  EXPECT_NEAR(point.a[0] * to_the_right.a[0] + point.a[2] * to_the_right.a[2], step, 1e-5);
  EXPECT_GT(point.a[0] * ahead.a[0] + point.a[2] * ahead.a[2], 0);
}

TEST(Stereo, DomeTurnsAboutItsZenith) {
  const double distance = 4;
  const Vec3 point = {{0, distance * std::sin(1.0), distance * std::cos(1.0)}};
  const Seen seen = see(stereo_of(StereoMode::parallel), Projection::fisheye, point);
  const double radius = 200 * 1.0 / (0.5 * pi);
  const auto around = [](const reference::Splat& splat) {
    return std::atan2(splat.y - 200, splat.x - 200);
  };
  EXPECT_NEAR(std::hypot(seen.right.x - 200, seen.right.y - 200), radius, 1e-3);
  EXPECT_NEAR(around(seen.right) - around(seen.left), std::asin(step / distance), 1e-5);
}

TEST(Stereo, WideAnglesLeaveOutWhatLiesBetweenTheEyes) {
  Frame frame = frame_for(Projection::equirectangular, {{0, 0, 0.9 * step}});
  frame.camera =
      eye_camera(frame.camera, frame.projection, stereo_of(StereoMode::parallel), Eye::right);
  EXPECT_TRUE(reference::project(frame).empty());
}

TEST(Stereo, RefusesWhatShowsNoDepth) {
  EXPECT_THROW(check_stereo(stereo_of(StereoMode::off_axis), Projection::orthographic), UsageError);
  EXPECT_THROW(check_stereo(stereo_of(StereoMode::toe_in), Projection::cube), UsageError);
  for (const double bad : {0.0, -1.0, 46.0, std::nan("")}) {
    Stereo stereo;
    stereo.angle_degrees = bad;
    EXPECT_THROW(check_stereo(stereo, Projection::perspective), UsageError) << bad;
  }
}

}  // namespace
}  // namespace splotchcl::test
