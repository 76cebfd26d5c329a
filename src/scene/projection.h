#pragma once

#include <optional>

#include "splotchcl/camera.h"
#include "splotchcl/vector.h"

// Where projections put a particle: the formulas of docs/projections.md.
namespace splotchcl {

// Pixels of the whole picture.
struct Projected {
  double x = 0, y = 0;
  double depth = 0;              // by which limits and order go: z, or the distance
  double pixels_per_length = 0;  // of a cloud's width; along y where that is not the same
  double cos_latitude = 1;       // in equirectangular pictures
  double sine_latitude = 0;      // likewise, positive below the horizon
};

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

// The ellipse as which an equirectangular picture shows a splat of this height. Another one, half
// a period along, is its mirror image over the nearer pole (docs/projections.md).
struct PanoramaEllipse {
  double y = 0;        // of its center, nearer to the pole than the cloud's place
  double stretch = 1;  // so many times as wide as high: the splat keeps its flux
};
PanoramaEllipse panorama_ellipse(const Projected& place, double sigma, const CameraFrame& camera);
double mirrored_over_pole(double y, const CameraFrame& camera);

// How many times as wide as high a splat of height sigma (pixels) is: 1, except in equirectangular
// pictures.
double stretch_along_x(const Projected& place, double sigma, const CameraFrame& camera,
                       Projection projection);

// Of an eye's head (CameraFrame), along the camera's right, down and forward axes.
Vec3 turn_axis_in_view(const CameraFrame& camera);

// The pixels after which an equirectangular picture repeats itself, 0 for others.
double period_along_x(const CameraFrame& camera, Projection projection);

}  // namespace splotchcl
