#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"

// The reference renderer, also called the oracle: scalar, in double precision, written for
// reading. It shares no code with the kernels. Its stages have the kernels' names, so each can be
// compared.
namespace splotchcl::reference {

// A projected particle, a Gaussian of matter whose column at a point of the picture is
//   X = weight * exp(-((x_pixel - x) / (stretch sigma))^2 - ((y_pixel - y) / sigma)^2).
// Positions and widths are in pixels of the whole picture.
struct Splat {
  double x = 0, y = 0;
  double sigma = 0;    // after kernel.min_radius, before any pixel averaging
  double stretch = 1;  // along x the width is stretch * sigma
  // On a face of a cube, where focal_pixels is above 0, another shape takes the place of that
  // (docs/projections.md, "Faces of a cube"), with the squares of widths in pixels; sigma and
  // stretch are those of its light along the axes, nearly.
  struct OnFace {
    double focal_pixels = 0, middle_x = 0, middle_y = 0;
    double squared_width = 0, footprint = 0, secant2 = 1;
  } on_face;
  double weight = 0;          // w, divided by the reference column, times intensity
  double emission[3] = {};    // E of the light model: brightness * palette etc., without w
  double absorption[3] = {};  // A likewise; E X and A X with X = weight * shape
  // Of a cloud around the camera (Frame::through_clouds; docs/projections.md), which in a pixel has
  // the column weight * (ray_part * what its ray finds + splat_part * shape).
  bool is_around = false;
  double ray_part = 0, splat_part = 1;
  Vec3 center{};  // from the camera along right, down and forward, as the eye sees it, in its sigma
  // By which splats are sorted: the depth as 48 bits (docs/dev/accuracy.md), or the bits of the
  // field's binary32 value, turned so that integers have the order of the values and -0 is +0.
  std::uint64_t key = 0;
  std::uint64_t particle = 0;  // index over all components, in component and file order
};

// Drawable particles in component and file order. Left out: bad values (count_bad),
// z outside the limits. Clouds around the camera are drawn behind it, too; splats that the
// projection cannot show have splat_part 0. Nothing is left out for lying off the image. An
// equirectangular picture repeats itself: a particle has a splat for each copy that reaches the
// picture, or one if none does, one after the other.
std::vector<Splat> project(const Frame& frame);

// Number of particles with bad values: any that is not finite, h <= 0, weight < 0, a
// color of its own < 0.
std::uint64_t count_bad(const Frame& frame);

// By key, nearest first as frame.sort says; of equal keys clouds around the camera last; stable.
void sort(std::vector<Splat>& splats, const SortOrder& order);

// X of the splat in pixel (x, y) per unit weight: the mean over the pixel (two
// differences of erf) or the center value, cut if the kernel says so. On a face of a cube the
// center value always, of a shape that is as wide as a pixel makes it (docs/projections.md).
double shape(const Splat& splat, int x, int y, const KernelSettings& kernel);

// The column that a ray from the camera finds in front of it, of a cloud of central column 1.
// `center` is the cloud's from the camera, in its sigma; `direction` a unit vector along the same
// axes. With t = center . direction and b its distance from the ray: exp(-b^2) (1 + erf(t)) / 2.
double ray_shape(const Vec3& center, const Vec3& direction);

// What a splat, or several, make of the light behind a pixel, per channel: I becomes
// exp(-tau) I + S. One splat of column X has tau = A X and S = E X phi(tau), where
// phi(y) = (1 - exp(-y)) / y (docs/scene.md): equation (3) of the paper that light_model.h names,
// without its division by A.
struct Layer {
  double optical_depth[3] = {};  // tau
  double source[3] = {};         // S
};
// Both in one: tau = tau_near + tau_far, S = S_near + exp(-tau_near) S_far.
Layer over(const Layer& near_layer, const Layer& far_layer);

// The layer of one pixel: every splat of the list in order (nearest first).
Layer composite_pixel(const std::vector<Splat>& splats, int x, int y, const Frame& frame);

// The whole frame: frame.crop in size. `progress` (may be empty) takes the fraction done, from 0
// to 1. The frame's tolerance is not looked at.
ReferenceImage render(const Frame& frame, const std::function<void(double)>& progress = {});

}  // namespace splotchcl::reference
