#include "splotchcl/camera.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "scene/constants.h"
#include "splotchcl/error.h"

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

CameraFrame make_camera_frame(const Camera& camera, int width, int height) {
  using namespace boost::qvm;
  check_finite(camera.position, "camera.position");
  check_finite(camera.look_at, "camera.look_at");
  check_finite(camera.sky, "camera.sky");
  check_limits(camera);
  check_width(camera);
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

}  // namespace splotchcl
