#pragma once

#include <optional>

#include "splotchcl/vector.h"

namespace splotchcl {

enum class Projection {
  perspective,
  orthographic,  // the scale at the look-at distance, everywhere
};

// Where the picture is taken from. Lengths are in the snapshot's length unit.
struct Camera {
  Vec3 position = {{0, 0, 0}};
  Vec3 look_at = {{0, 0, 1}};
  Vec3 sky = {{0, 1, 0}};             // shown upwards; any direction not parallel to the view
  double field_of_view_degrees = 45;  // horizontal, 0 < value < 180
  Projection projection = Projection::perspective;
  // Limits of z, the distance along the view direction. Without a near limit,
  // perspective leaves out z < 0.1 h of the particle itself (its disc would cover
  // the sky), orthographic leaves out z < 0.
  std::optional<double> near_limit;
  std::optional<double> far_limit;
};

// The camera as both renderers use it: orthonormal axes x right, y down, z forward.
//   perspective:  x_pixel = centre_x + focal_pixels * x / z
//   orthographic: x_pixel = centre_x + pixels_per_length * x
// Pixel centres lie at i + 1/2; row 0 is the top of the picture.
struct CameraFrame {
  Vec3 position;
  Vec3 right, down, forward;
  double focal_pixels = 0;  // (width / 2) / tan(field of view / 2)
  double look_at_distance = 0;
  double pixels_per_length = 0;  // focal_pixels / look_at_distance
  double centre_x = 0, centre_y = 0;
};

// Throws UsageError for a field of view outside (0, 180), a camera at its look-at
// point, a sky direction (almost) parallel to the view, or limits out of order.
CameraFrame make_camera_frame(const Camera& camera, int width, int height);

}  // namespace splotchcl
