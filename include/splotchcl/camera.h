#pragma once

#include <optional>

#include "splotchcl/vector.h"

namespace splotchcl {

// How directions become places in the picture; docs/projections.md has the formulas.
enum class Projection {
  perspective,
  orthographic,     // the scale at the look-at distance, everywhere
  fisheye,          // a dome: the angle from the view direction is linear in the radius
  equirectangular,  // 360 degrees: longitude and latitude are linear in x and y
  cube,             // six square faces of 90 degrees
};

// Fisheye, equirectangular and cube: limits and depth are the distance from the camera, not
// the distance along the view direction, so that pictures in all directions fit together.
bool is_wide_angle(Projection projection);

// The six faces of a cube as one picture of 3 x 2 faces, or as six.
enum class CubeLayout { sheet, files };

// A lens, through which a point out of focus is a disc, the circle of confusion: a Gaussian of the
// disc's second moment here, which makes a cloud a wider one of the same light. Its diameter at the
// distance of focus is aperture * |depth - focus| / depth.
struct Lens {
  double aperture = 0;  // its diameter, in lengths; 0: all is sharp
  double focus = 0;     // the depth that is sharp, > 0 with an aperture
};

// How light fades with depth, smoothly: from none at the near limit, or at the camera, to all of it
// so much farther, and to none at the far limit from so much before it. 0: not at all.
struct DepthFade {
  double near_length = 0, far_length = 0;  // in lengths
  bool is_set() const { return near_length > 0 || far_length > 0; }
};

// Where the picture is taken from. Lengths are in the snapshot's length unit.
struct Camera {
  Vec3 position = {{0, 0, 0}};
  Vec3 look_at = {{0, 0, 1}};
  Vec3 sky = {{0, 1, 0}};  // shown upwards; any direction not parallel to the view
  // Between the left and right edges; of a fisheye across its circle. Unset: 45, fisheye 180,
  // equirectangular 360, cube 90.
  std::optional<double> field_of_view_degrees;
  Projection projection = Projection::perspective;
  // Limits of z, the distance along the view direction (wide angles: of the distance).
  // Without a near limit, orthographic leaves out z < 0. All others draw what is in front of the
  // camera of clouds around it, or without through_clouds leave out z < 0.1 h of the particle
  // itself (its disc would cover the sky).
  std::optional<double> near_limit;
  std::optional<double> far_limit;
  // Clouds around the camera are what each ray finds of them in front of it
  // (docs/projections.md); false: splats like all others. Nothing to orthographic cameras.
  bool through_clouds = true;
  CubeLayout cube_layout = CubeLayout::sheet;
  // Of the picture at the look-at distance, in lengths, > 0, instead of a field of view. Not for
  // wide angles.
  std::optional<double> width = std::nullopt;
  // As scene files say it: where the camera, as it is turned, is moved to look at. Reading a scene
  // moves position and look_at by it and unsets it; nothing else looks at it.
  std::optional<Vec3> center = std::nullopt;
  // Of a fisheye under a dome: the look-at point is at the bottom of the picture, in front of the
  // audience, so many degrees above the dome's rim, and the sky is up; -90 to 90. Unset: the
  // look-at point is in the middle.
  std::optional<double> dome_tilt_degrees = std::nullopt;
  // Of perspective cameras: a lens of this diameter, >= 0, and the depth of which it makes sharp
  // pictures, > 0. Unset: the distance of the look-at point.
  double aperture = 0;
  std::optional<double> focus = std::nullopt;
  DepthFade fade = {};  // its far length needs a far limit
};

// The field of view in degrees: as the camera says, by its width, or the projection's own.
double field_of_view_degrees(const Camera& camera);

// The camera as both renderers use it: orthonormal axes x right, y down, z forward.
//   perspective:  x_pixel = center_x + focal_pixels * x / z
//   orthographic: x_pixel = center_x + pixels_per_length * x
// and y_pixel likewise from y, with x, y, z the particle's place along the axes, in lengths, from
// the camera. Pixel centres lie at i + 1/2; row 0 is the top of the picture.
struct CameraFrame {
  Vec3 position;              // in lengths
  Vec3 right, down, forward;  // unit vectors, right x down = forward
  // (width / 2) / tan(field of view / 2); pixels per radian in fisheye and equirectangular.
  double focal_pixels = 0;
  double look_at_distance = 0;        // in lengths, > 0
  double pixels_per_length = 0;       // focal_pixels / look_at_distance
  double center_x = 0, center_y = 0;  // in pixels, where the view direction meets the picture
  // Stereo in all directions: every particle is turned about turn_axis (a unit vector, the
  // upward direction of a head that looks around) by asin(eye_offset / its distance), to the
  // left for an eye that lies eye_offset > 0 to the right. 0: no stereo.
  double eye_offset = 0;
  Vec3 turn_axis = {{0, 0, 0}};
};

// For a picture of width x height pixels, each > 0.
// Throws UsageError for a field of view that the projection cannot have, a picture that does
// not fit it, a camera at its look-at point, a sky direction (almost) parallel to the view,
// or limits out of order.
CameraFrame make_camera_frame(const Camera& camera, int width, int height);

// The same camera as the original program has it (PixelConvention::original): rows grow along
// the sky direction, and samples lie on whole coordinates.
CameraFrame in_original_convention(const CameraFrame& camera);

}  // namespace splotchcl
