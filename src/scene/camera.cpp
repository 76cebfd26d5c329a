#include "splotchcl/camera.h"

#include <cmath>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double pi = 3.14159265358979323846;

// The sine of the angle between sky and view under which the picture's upward
// direction is lost in the rounding of the inputs.
constexpr double smallest_sky_sine = 1e-9;

std::string text(const Vec3& v) {
  return "(" + std::to_string(v.a[0]) + ", " + std::to_string(v.a[1]) + ", " +
         std::to_string(v.a[2]) + ")";
}

void check_finite(const Vec3& v, const char* key) {
  if (!std::isfinite(v.a[0]) || !std::isfinite(v.a[1]) || !std::isfinite(v.a[2])) {
    throw UsageError(std::string(key) + ": found " + text(v) + ", expected finite numbers");
  }
}

void check_limits(const Camera& camera) {
  if (camera.near_limit && camera.far_limit && !(*camera.near_limit < *camera.far_limit)) {
    throw UsageError("camera.near: found " + std::to_string(*camera.near_limit) +
                     ", expected less than camera.far, which is " +
                     std::to_string(*camera.far_limit));
  }
}

}  // namespace

CameraFrame make_camera_frame(const Camera& camera, int width, int height) {
  using namespace boost::qvm;
  check_finite(camera.position, "camera.position");
  check_finite(camera.look_at, "camera.look_at");
  check_finite(camera.sky, "camera.sky");
  check_limits(camera);
  if (!(camera.field_of_view_degrees > 0 && camera.field_of_view_degrees < 180)) {
    throw UsageError("camera.field_of_view: found " +
                     std::to_string(camera.field_of_view_degrees) +
                     " degrees, expected more than 0 and less than 180");
  }

  const Vec3 view = camera.look_at - camera.position;
  const double distance = mag(view);
  if (!(distance > 0)) {
    throw UsageError("camera.look_at: found the camera's own position " + text(camera.look_at) +
                     ", expected another point, so that there is a view direction");
  }
  const double sky_length = mag(camera.sky);
  const Vec3 right = cross(view, camera.sky);
  if (!(sky_length > 0) || !(mag(right) > smallest_sky_sine * distance * sky_length)) {
    throw UsageError("camera.sky: found " + text(camera.sky) +
                     ", parallel to the view direction " + text(view) +
                     ", expected any other direction");
  }

  CameraFrame frame;
  frame.position = camera.position;
  frame.forward = view / distance;
  frame.right = normalized(right);
  frame.down = cross(frame.forward, frame.right);
  frame.focal_pixels = 0.5 * width / std::tan(0.5 * camera.field_of_view_degrees * pi / 180);
  frame.look_at_distance = distance;
  frame.pixels_per_length = frame.focal_pixels / distance;
  frame.centre_x = 0.5 * width;
  frame.centre_y = 0.5 * height;
  return frame;
}

}  // namespace splotchcl
