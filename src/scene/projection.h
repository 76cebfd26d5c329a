#pragma once

#include <array>
#include <optional>

#include "splotchcl/camera.h"
#include "splotchcl/vector.h"

// Where projections put a particle: the formulas of docs/projections.md.
namespace splotchcl {

// Pixels of the whole picture.
struct Projected {
  double x = 0, y = 0;
  double depth = 0;  // by which limits and order go: z, or the distance
  // Of a cloud's width; along y in equirectangular pictures, on a face of a cube across the line
  // from its middle.
  double pixels_per_length = 0;
  double cos_latitude = 1;   // in equirectangular pictures
  double sine_latitude = 0;  // likewise, positive below the horizon
};

// An offset from the camera in lengths, along its right, down and forward axes.
Vec3 along_axes(const Vec3& offset, const CameraFrame& camera);

// `from_camera`: along the camera's right, down and forward axes. Nothing where the projection
// cannot show the point, wherever the picture ends: behind a perspective camera or a cube's
// face, or nearer than the eye's offset in stereo.
std::optional<Projected> project_point(const Vec3& from_camera, const CameraFrame& camera,
                                       Projection projection);

// The direction that is seen at a place of the picture, in pixels, as a unit vector along right,
// down and forward: what project_point() takes there. Beside the picture the formulas go on. Not of
// orthographic cameras, which look in one direction.
Vec3 direction_at(double x, double y, const CameraFrame& camera, Projection projection);

// Where an eye beside the camera sees a point: turned about its head, as far away as it is. The
// point itself where there is no such eye.
Vec3 seen_by_eye(const Vec3& from_camera, const CameraFrame& camera, Projection projection);

// The ellipse as which an equirectangular picture shows a splat of this height. Two others, half a
// period along, are its mirror images over the poles (docs/projections.md).
struct PanoramaEllipse {
  double y = 0;        // of its center, nearer to the pole than the cloud's place
  double stretch = 1;  // so many times as wide as high: the splat keeps its flux
};
PanoramaEllipse panorama_ellipse(const Projected& place, double sigma, const CameraFrame& camera);
// Over the upper and the lower pole.
std::array<double, 2> mirrored_over_poles(double y, const CameraFrame& camera);

// Clouds are drawn at most so wide, in pixels: farther around the sky there is nothing to tell
// them apart by.
double widest_in_panorama(const CameraFrame& camera);

// A cloud on a face of a cube: what rays find of it, seen through a pixel's footprint, so that
// faces agree at their edges (docs/projections.md). At a pixel dx, dy pixels from its center, which
// looks at the tangents x and y from the face's axis, with k = 1 + x^2 + y^2, g = squared_width and
// m = g k + footprint its shape is
//   g k / m * exp(-(dx^2 + dy^2 + (x dy - y dx)^2) / (m secant2)).
struct FaceEllipse {
  double squared_width = 0;         // of sigma as it would be in the middle of the face, in pixels
  double footprint = 0;             // likewise, of a pixel
  double secant2 = 1;               // 1 / cosine^2 of the angle from the face's axis
  double sigma_x = 0, sigma_y = 0;  // in pixels, of its light along x and along y, nearly
};

// What a footprint is: a pixel has the variance 1/12 along each axis, in sigma^2 twice that. Clouds
// are drawn at least so wide, since the values at pixels' centers would show more or less of their
// light, as they happen to lie.
constexpr double face_footprint = 1.0 / 6, narrowest_on_face_squared = 2.0 / 3;

// `sigma`: Projected::pixels_per_length times the cloud's.
FaceEllipse face_ellipse(const Projected& place, double sigma, const CameraFrame& camera,
                         bool has_footprint);

// 1 / cosine^2 of the angle between a face's axis and what is seen at a place of the picture.
double secant2_at(double x, double y, const CameraFrame& camera);

// The area of a splat of height sigma (pixels) over that of a circle so high: 1, except in
// equirectangular pictures and on faces of a cube.
double stretch_of_area(const Projected& place, double sigma, const CameraFrame& camera,
                       Projection projection);

// Of an eye's head (CameraFrame), along the camera's right, down and forward axes.
Vec3 turn_axis_in_view(const CameraFrame& camera);

// The pixels after which an equirectangular picture repeats itself, 0 for others.
double period_along_x(const CameraFrame& camera, Projection projection);

}  // namespace splotchcl
