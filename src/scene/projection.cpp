#include "scene/projection.h"

#include <algorithm>
#include <boost/qvm/quat_operations.hpp>
#include <boost/qvm/quat_vec_operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"

namespace splotchcl {
namespace {

// A fisheye picture of 360 degrees draws the point right behind the camera as its whole rim.
// Clouds within 6 degrees of it grow no wider.
constexpr double smallest_sine_behind = 0.1;
// What lies less than this off the axis is drawn as if it lay on it and to the right: where it
// would be drawn on the rim is a matter of roundings (kernels/project/wide_angle_point.cl).
constexpr double sine_on_axis = 0x1p-40;

std::optional<Projected> project_straight(const Vec3& v, const CameraFrame& camera,
                                          bool perspective) {
  const double z = v.a[2];
  if (perspective && z <= 0) return std::nullopt;
  const double scale = perspective ? camera.focal_pixels / z : camera.pixels_per_length;
  return Projected{camera.center_x + scale * v.a[0], camera.center_y + scale * v.a[1], z, scale};
}

// The direction `u` as an eye beside the camera sees it, turned about the head's axis.
Vec3 turned(const Vec3& u, double sine, const CameraFrame& camera) {
  using namespace boost::qvm;
  return rot_quat(turn_axis_in_view(camera), std::asin(sine)) * u;
}

Projected project_fisheye(const Vec3& u, double distance, const CameraFrame& camera) {
  const double sine = std::hypot(u.a[0], u.a[1]);
  const double angle = std::atan2(sine, u.a[2]);
  const double radius = camera.focal_pixels * angle;
  const bool is_off_axis = sine > sine_on_axis;
  const double cosine_around = is_off_axis ? u.a[0] / sine : 1;
  const double sine_around = is_off_axis ? u.a[1] / sine : 0;
  const double widening_sine = u.a[2] > 0 ? sine : std::max(sine, smallest_sine_behind);
  const double widening = widening_sine > 0 ? angle / widening_sine : 1;
  Projected place;
  place.x = camera.center_x + radius * cosine_around;
  place.y = camera.center_y + radius * sine_around;
  place.pixels_per_length = camera.focal_pixels / distance * std::sqrt(widening);
  return place;
}

Projected project_equirectangular(const Vec3& u, double distance, const CameraFrame& camera) {
  Projected place;
  place.cos_latitude = std::hypot(u.a[0], u.a[2]);
  place.sine_latitude = u.a[1];
  place.x = camera.center_x + camera.focal_pixels * std::atan2(u.a[0], u.a[2]);
  place.y = camera.center_y + camera.focal_pixels * std::atan2(u.a[1], place.cos_latitude);
  place.pixels_per_length = camera.focal_pixels / distance;
  return place;
}

// The corners of a face are 55 degrees from its axis. A cloud beyond 86 degrees that is not around
// the camera has exp(-36) of its peak there.
constexpr double smallest_cosine_of_face = 0x1p-4;

std::optional<Projected> project_cube_face(const Vec3& u, double distance,
                                           const CameraFrame& camera) {
  if (!(u.a[2] > smallest_cosine_of_face)) return std::nullopt;
  Projected place;
  place.x = camera.center_x + camera.focal_pixels * u.a[0] / u.a[2];
  place.y = camera.center_y + camera.focal_pixels * u.a[1] / u.a[2];
  place.pixels_per_length = camera.focal_pixels / (distance * u.a[2]);
  return place;
}

}  // namespace

Vec3 along_axes(const Vec3& offset, const CameraFrame& camera) {
  using boost::qvm::dot;
  return {{dot(offset, camera.right), dot(offset, camera.down), dot(offset, camera.forward)}};
}

std::optional<Projected> project_point(const Vec3& from_camera, const CameraFrame& camera,
                                       Projection projection) {
  using namespace boost::qvm;
  if (!is_wide_angle(projection)) {
    return project_straight(from_camera, camera, projection == Projection::perspective);
  }
  const double distance = mag(from_camera);
  if (!(distance > std::abs(camera.eye_offset))) return std::nullopt;
  Vec3 u = from_camera / distance;
  if (camera.eye_offset != 0) u = turned(u, camera.eye_offset / distance, camera);
  std::optional<Projected> place;
  switch (projection) {
    case Projection::fisheye:
      place = project_fisheye(u, distance, camera);
      break;
    case Projection::equirectangular:
      place = project_equirectangular(u, distance, camera);
      break;
    default:
      place = project_cube_face(u, distance, camera);
  }
  if (place) place->depth = distance;
  return place;
}

Vec3 direction_at(double x, double y, const CameraFrame& camera, Projection projection) {
  using namespace boost::qvm;
  const double across = (x - camera.center_x) / camera.focal_pixels;
  const double along = (y - camera.center_y) / camera.focal_pixels;
  if (projection == Projection::fisheye) {
    const double angle = std::hypot(across, along);
    const double sine_of_angle = angle > 0 ? std::sin(angle) / angle : 1;
    return {{across * sine_of_angle, along * sine_of_angle, std::cos(angle)}};
  }
  if (projection == Projection::equirectangular) {
    const double cosine = std::cos(along);
    return {{std::sin(across) * cosine, std::sin(along), std::cos(across) * cosine}};
  }
  return normalized(Vec3{{across, along, 1}});
}

Vec3 seen_by_eye(const Vec3& from_camera, const CameraFrame& camera, Projection projection) {
  using namespace boost::qvm;
  const double distance = mag(from_camera);
  if (!is_wide_angle(projection) || camera.eye_offset == 0 || distance == 0) return from_camera;
  // Nearer than the eye is to the middle of the head it is turned no farther.
  return turned(from_camera, std::clamp(camera.eye_offset / distance, -1.0, 1.0), camera);
}

// In units of the cloud's angular width s, with the pole at 0: a cloud at the distance u is an
// ellipse at m and one at -m. As they lie in the picture, rows of length |r| hold
// sqrt(pi) Q(m) = sqrt(pi) (exp(-m^2) + sqrt(pi) m erf(m)) of them, so that the width sqrt(pi) / Q
// keeps the cloud's flux. Their mean of r^2 is the cloud's, u^2 + 1, where
// (m^2 + 1/2) erf(m) + m exp(-m^2) / sqrt(pi) = u^2, which this m solves to 0.3 %.
PanoramaEllipse panorama_ellipse(const Projected& place, double sigma, const CameraFrame& camera) {
  constexpr double nowhere = 1e-18, farthest = 1e15;
  const double s = sigma / camera.focal_pixels;
  const double sine = std::max(std::abs(place.sine_latitude), nowhere);
  const double u = std::min(place.cos_latitude / (s * sine), farthest);
  const double u2 = u * u;
  const double k = 0.5 + (4 / pi - 0.5) / (1 + u2 * (3.09 - 1.8 / (1 + 0.5 * u2)));
  const double root = std::sqrt(u2 + k), m = u2 / root;
  PanoramaEllipse ellipse;
  const double nearer = sigma * (u * k / (root * (root + u)));
  ellipse.y = place.y + std::copysign(nearer, place.sine_latitude);
  // sine * m, which is finite at the horizon.
  const double sine_m = place.cos_latitude / s * (u / root);
  ellipse.stretch =
      std::sqrt(pi) / s / (sine * std::exp(-m * m) + std::sqrt(pi) * sine_m * std::erf(m));
  return ellipse;
}

std::array<double, 2> mirrored_over_poles(double y, const CameraFrame& camera) {
  const double to_pole = 0.5 * pi * camera.focal_pixels;
  return {2 * (camera.center_y - to_pole) - y, 2 * (camera.center_y + to_pole) - y};
}

double widest_in_panorama(const CameraFrame& camera) {
  constexpr double radians = 2;
  return radians * camera.focal_pixels;
}

// Wider clouds are what rays find, as those around the camera are.
constexpr double angle_of_rays = 1.0 / 12;

FaceEllipse face_ellipse(const Projected& place, double sigma, const CameraFrame& camera,
                         bool has_footprint) {
  const double x = (place.x - camera.center_x) / camera.focal_pixels;
  const double y = (place.y - camera.center_y) / camera.focal_pixels;
  FaceEllipse ellipse;
  ellipse.secant2 = 1 + x * x + y * y;
  ellipse.squared_width = sigma * sigma / ellipse.secant2;
  const double angle = std::sqrt(ellipse.squared_width) / camera.focal_pixels;
  const double u = std::clamp(2 * angle / angle_of_rays - 1, 0.0, 1.0);
  const double kept = 1 - u * u * (3 - 2 * u);
  if (has_footprint) {
    ellipse.footprint =
        std::max(face_footprint, narrowest_on_face_squared - ellipse.squared_width) * kept;
  }
  // Of the ellipse that it is where the pixels have its own secant.
  const double across = sigma * sigma + ellipse.footprint;
  ellipse.sigma_x = std::sqrt(across * (1 + x * x));
  ellipse.sigma_y = std::sqrt(across * (1 + y * y));
  return ellipse;
}

double secant2_at(double x, double y, const CameraFrame& camera) {
  const double across = (x - camera.center_x) / camera.focal_pixels;
  const double along = (y - camera.center_y) / camera.focal_pixels;
  return 1 + across * across + along * along;
}

double stretch_of_area(const Projected& place, double sigma, const CameraFrame& camera,
                       Projection projection) {
  if (projection == Projection::equirectangular)
    return panorama_ellipse(place, sigma, camera).stretch;
  return projection == Projection::cube ? std::sqrt(secant2_at(place.x, place.y, camera)) : 1;
}

Vec3 turn_axis_in_view(const CameraFrame& camera) {
  return along_axes(camera.turn_axis, camera);
}

double period_along_x(const CameraFrame& camera, Projection projection) {
  return projection == Projection::equirectangular ? 2 * pi * camera.focal_pixels : 0;
}

}  // namespace splotchcl
