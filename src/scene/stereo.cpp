#include "splotchcl/stereo.h"

#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <sstream>

#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double largest_angle_degrees = 45;

// How far the eye lies to the right of the camera, in world lengths.
double eye_offset(const CameraFrame& camera, const Stereo& stereo, Eye eye) {
  const double step = stereo.angle_degrees * pi / 180 * camera.look_at_distance;
  if (stereo.eyes == StereoEyes::centered) return eye == Eye::left ? -0.5 * step : 0.5 * step;
  return eye == Eye::left ? 0 : step;
}

// Where the sky is, also if rows of the picture grow towards it.
Vec3 upwards(const CameraFrame& camera) {
  return boost::qvm::cross(camera.right, camera.forward);
}

// The axes of an eye at `offset` that looks at the same point. Its sky is the part of the
// camera's that is perpendicular to the view, as in the paper, and so `down` stays.
void turn_to_look_at(CameraFrame& eye, double offset) {
  using namespace boost::qvm;
  const Vec3 up = upwards(eye);
  const Vec3 view = eye.look_at_distance * eye.forward - offset * eye.right;
  const double distance = mag(view);
  eye.forward = view / distance;
  eye.right = cross(eye.forward, up);
  eye.pixels_per_length *= eye.look_at_distance / distance;
  eye.look_at_distance = distance;
}

// A head turns about the vertical of a 360 degree picture, and under a dome about the
// direction of its zenith, which is where the camera looks.
Vec3 head_axis(const CameraFrame& camera, Projection projection) {
  return projection == Projection::fisheye ? camera.forward : upwards(camera);
}

}  // namespace

void check_stereo(const Stereo& stereo, Projection projection) {
  if (!(stereo.angle_degrees > 0 && stereo.angle_degrees <= largest_angle_degrees)) {
    std::ostringstream message;
    message << "stereo.angle: found " << stereo.angle_degrees
            << " degrees, expected more than 0 and at most " << largest_angle_degrees;
    throw UsageError(message.str());
  }
  const bool turns = stereo.mode == StereoMode::toe_in;
  if (projection == Projection::orthographic && !turns) {
    throw UsageError(
        "stereo.mode: found parallel view directions with the orthographic projection, which "
        "then shows both eyes the same; expected \"toe_in\", or another camera.projection");
  }
  if (is_wide_angle(projection) && turns) {
    throw UsageError(
        "stereo.mode: found \"toe_in\" with a projection that looks in all directions; expected "
        "\"off_axis\" or \"parallel\"");
  }
}

CameraFrame eye_camera(const CameraFrame& camera, Projection projection, const Stereo& stereo,
                       Eye eye) {
  using namespace boost::qvm;
  check_stereo(stereo, projection);
  const double offset = eye_offset(camera, stereo, eye);
  CameraFrame frame = camera;
  if (offset == 0) return frame;
  if (is_wide_angle(projection)) {
    frame.eye_offset = offset;
    frame.turn_axis = head_axis(camera, projection);
    if (stereo.mode == StereoMode::off_axis) {
      // The camera turns by as much as what lies at the look-at distance, which so stays where it
      // is.
      const auto turn = rot_quat(frame.turn_axis, std::asin(offset / camera.look_at_distance));
      frame.right = turn * camera.right;
      frame.down = turn * camera.down;
      frame.forward = turn * camera.forward;
    }
    return frame;
  }
  frame.position = camera.position + offset * camera.right;
  if (stereo.mode == StereoMode::toe_in) {
    turn_to_look_at(frame, offset);
  } else if (stereo.mode == StereoMode::off_axis) {
    frame.center_x += camera.pixels_per_length * offset;
  }
  return frame;
}

}  // namespace splotchcl
