#include "splotchcl/camera.h"

#include <algorithm>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <sstream>
#include <string>

#include "scene/constants.h"
#include "splotchcl/cube.h"
#include "splotchcl/error.h"
#include "splotchcl/stereo.h"

namespace splotchcl {
namespace {

// The sine of the angle between sky and view under which the picture's upward
// direction is lost in the rounding of the inputs.
constexpr double smallest_sky_sine = 1e-9;

// Six digits, small and large numbers alike.
std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(const Vec3& v) {
  return "(" + text(v.a[0]) + ", " + text(v.a[1]) + ", " + text(v.a[2]) + ")";
}

void check_finite(const Vec3& v, const char* key) {
  if (!std::isfinite(v.a[0]) || !std::isfinite(v.a[1]) || !std::isfinite(v.a[2])) {
    throw UsageError(std::string(key) + ": found " + text(v) + ", expected finite numbers");
  }
}

double largest_component(const Vec3& v) {
  return std::max({std::abs(v.a[0]), std::abs(v.a[1]), std::abs(v.a[2])});
}

void check_limits(const Camera& camera) {
  if (camera.near_limit && camera.far_limit && !(*camera.near_limit < *camera.far_limit)) {
    throw UsageError("camera.near: found " + text(*camera.near_limit) +
                     ", expected less than camera.far, which is " + text(*camera.far_limit));
  }
}

void check_fade(const Camera& camera) {
  if (camera.fade.far_length == 0 || camera.far_limit) return;
  throw UsageError("camera.far_fade: found " + text(camera.fade.far_length) +
                   " without a far limit, expected camera.far as well, where all light has faded");
}

void check_lens(const Camera& camera) {
  if (camera.aperture == 0 || camera.projection == Projection::perspective) return;
  throw UsageError("camera.aperture: found " + text(camera.aperture) +
                   " in another than the perspective projection, expected 0 there: all is sharp");
}

double largest_field_of_view(Projection projection) {
  return projection == Projection::fisheye || projection == Projection::equirectangular ? 360 : 180;
}

void check_width(const Camera& camera) {
  if (!camera.width) return;
  if (is_wide_angle(camera.projection)) {
    throw UsageError("camera.width: found " + text(*camera.width) +
                     " in a wide-angle projection, expected perspective or orthographic; set "
                     "camera.field_of_view instead");
  }
  if (!(*camera.width > 0) || !std::isfinite(*camera.width)) {
    throw UsageError("camera.width: found " + text(*camera.width) +
                     ", expected a finite number > 0");
  }
}

void check_field_of_view(const Camera& camera) {
  if (camera.width) return;
  const double found = field_of_view_degrees(camera);
  const std::string start = "camera.field_of_view: found " + text(found) + " degrees, expected ";
  if (camera.projection == Projection::cube) {
    if (found == 90) return;
    throw UsageError(start + "90, which the faces of a cube always have; leave it out");
  }
  const double largest = largest_field_of_view(camera.projection);
  const bool may_be_largest = largest == 360;
  if (found > 0 && (found < largest || (may_be_largest && found == largest))) return;
  throw UsageError(start + "more than 0 and " + (may_be_largest ? "at most " : "less than ") +
                   text(largest));
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void check_shape(const Camera& camera, int width, int height) {
  if (camera.projection == Projection::cube && width != height) {
    throw UsageError("image.size: found " + size_text(width, height) +
                     ", expected as high as wide, since it is the size of one face of the cube");
  }
  const double degrees_per_pixel = field_of_view_degrees(camera) / width;
  if (camera.projection == Projection::equirectangular && degrees_per_pixel * height > 180.5) {
    throw UsageError("image.size: found " + size_text(width, height) + ", which is " +
                     text(degrees_per_pixel * height) +
                     " degrees high in the equirectangular projection, expected at most 180: a "
                     "whole panorama is twice as wide as high");
  }
}

// Pixels per radian, or per unit of the tangent, in the middle of the picture.
double focal_length(const Camera& camera, int width, int height) {
  const double angle = field_of_view_degrees(camera) * pi / 180;
  switch (camera.projection) {
    case Projection::fisheye:
      return std::min(width, height) / angle;
    case Projection::equirectangular:
      return width / angle;
    case Projection::cube:
      return 0.5 * width;
    case Projection::perspective:
    case Projection::orthographic:
      break;
  }
  return 0.5 * width / std::tan(0.5 * angle);
}

}  // namespace

bool is_wide_angle(Projection projection) {
  return projection == Projection::fisheye || projection == Projection::equirectangular ||
         projection == Projection::cube;
}

double field_of_view_degrees(const Camera& camera) {
  using namespace boost::qvm;
  if (camera.width) {
    const double distance = mag(camera.look_at - camera.position);
    return 2 * std::atan(0.5 * *camera.width / distance) * 180 / pi;
  }
  if (camera.field_of_view_degrees) return *camera.field_of_view_degrees;
  switch (camera.projection) {
    case Projection::fisheye:
      return 180;
    case Projection::equirectangular:
      return 360;
    case Projection::cube:
      return 90;
    case Projection::perspective:
    case Projection::orthographic:
      break;
  }
  return 45;
}

namespace {

void check_dome(const Camera& camera) {
  if (!camera.dome_tilt_degrees) return;
  const double tilt = *camera.dome_tilt_degrees;
  if (camera.projection != Projection::fisheye) {
    throw UsageError("camera.dome_tilt: found " + text(tilt) +
                     " in another projection, expected camera.projection \"fisheye\"");
  }
  if (tilt >= -90 && tilt <= 90) return;
  throw UsageError("camera.dome_tilt: found " + text(tilt) + " degrees, expected -90 to 90");
}

// The dome's top is ahead, and what was ahead is at the bottom, so far above the rim.
void look_up(double tilt_degrees, CameraFrame& frame) {
  using namespace boost::qvm;
  const double angle = tilt_degrees * pi / 180;
  const Vec3 front = frame.forward, up = -frame.down;
  frame.forward = std::sin(angle) * front + std::cos(angle) * up;
  frame.down = std::cos(angle) * front - std::sin(angle) * up;
}

}  // namespace

CameraFrame make_camera_frame(const Camera& camera, int width, int height) {
  using namespace boost::qvm;
  check_finite(camera.position, "camera.position");
  check_finite(camera.look_at, "camera.look_at");
  check_finite(camera.sky, "camera.sky");
  check_limits(camera);
  check_fade(camera);
  check_lens(camera);
  check_width(camera);
  check_dome(camera);
  check_field_of_view(camera);
  check_shape(camera, width, height);

  const Vec3 view = camera.look_at - camera.position;
  const double distance = mag(view);
  if (!(distance > 0)) {
    throw UsageError("camera.look_at: found the camera's own position " + text(camera.look_at) +
                     ", expected another point, so that there is a view direction");
  }
  if (!std::isfinite(distance)) {
    throw UsageError("camera.look_at: found " + text(camera.look_at) +
                     ", too far from the camera to compute with, expected a nearer point");
  }
  const Vec3 forward = view / distance;
  // By its largest component first, so that no square overflows or underflows.
  const double sky_size = largest_component(camera.sky);
  const Vec3 sky = sky_size > 0 ? Vec3(camera.sky / sky_size) : camera.sky;
  const Vec3 right = cross(forward, sky);
  if (!(mag(right) > smallest_sky_sine)) {
    throw UsageError("camera.sky: found " + text(camera.sky) +
                     (sky_size > 0 ? ", parallel to the view direction " + text(view)
                                   : std::string(", which is no direction")) +
                     ", expected any other direction");
  }

  CameraFrame frame;
  frame.position = camera.position;
  frame.forward = forward;
  frame.right = normalized(right);
  frame.down = cross(forward, frame.right);
  if (camera.dome_tilt_degrees) look_up(*camera.dome_tilt_degrees, frame);
  // Not by way of an angle: a length of the data keeps all its digits.
  frame.focal_pixels =
      camera.width ? distance * width / *camera.width : focal_length(camera, width, height);
  frame.look_at_distance = distance;
  frame.pixels_per_length = frame.focal_pixels / distance;
  frame.center_x = 0.5 * width;
  frame.center_y = 0.5 * height;
  return frame;
}

CameraFrame in_original_convention(const CameraFrame& camera) {
  using namespace boost::qvm;
  CameraFrame frame = camera;
  frame.down = -frame.down;
  frame.center_x += 0.5;
  frame.center_y += 0.5;
  return frame;
}

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

std::array<CubeFace, 6> cube_faces(const CameraFrame& front) {
  using namespace boost::qvm;
  const Vec3 right = front.right, down = front.down, forward = front.forward;
  const Vec3 left = -right, up = -down, back = -forward;
  const auto face = [&front](const char* name, int column, int row, const Vec3& to_the_right,
                             const Vec3& downwards, const Vec3& ahead) {
    CubeFace face = {name, column, row, front};
    face.camera.right = to_the_right;
    face.camera.down = downwards;
    face.camera.forward = ahead;
    return face;
  };
  return {{face("right", 0, 0, back, down, right), face("left", 1, 0, forward, down, left),
           face("up", 2, 0, right, forward, up), face("down", 0, 1, right, back, down),
           face("front", 1, 1, right, down, forward), face("back", 2, 1, left, down, back)}};
}

}  // namespace splotchcl
