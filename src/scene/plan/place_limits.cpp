// How well the places of splats are known, in pixels, and what follows for sharp ones
// (docs/dev/accuracy.md, "Single precision").
#include "scene/plan/place_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {
namespace {

constexpr double rounding = 0x1p-24;

// The integers of splats' places hold the picture in 31 bits (picture_layout.cpp).
double largest_unit(const Frame& frame) {
  return 0x1p-30 * (std::max(frame.width, frame.height) + 256);
}

// Of a splat in the picture; the roundings are those of kernels/project/view.cl, x and y count from
// near the picture's middle.
void set_single_errors(const Frame& frame, PlaceLimits& limits) {
  const CameraFrame& camera = frame.camera;
  const double beside_x = std::abs(camera.center_x - 0.5 * frame.width);
  const double beside_y = std::abs(camera.center_y - 0.5 * frame.height);
  double per_pixel = 4;
  if (!is_wide_angle(frame.projection)) {
    // The scale errs as z does, by six roundings of the distance, three more and a division's.
    const bool is_flat = frame.projection == Projection::orthographic;
    const double corner = std::hypot(0.5 * frame.width + beside_x, 0.5 * frame.height + beside_y);
    per_pixel = is_flat ? 2 : 6 * std::hypot(1, corner / camera.focal_pixels) + 7;
  }
  limits.error_per_pixel = static_cast<float>(per_pixel + 2);
  // A unit of a splat's integers is a few roundings.
  const double unit = largest_unit(frame) / rounding;
  limits.error = static_cast<float>((per_pixel + 2) * (std::max(beside_x, beside_y) + 64) + unit);
}

// Of a splat whose place is computed in extended numbers: a unit of its integers, and the rounding
// of its place in a tile of at most 64 pixels.
double integer_place_error(const Frame& frame) {
  return largest_unit(frame) + 0x1p-19;
}

// The same with fractions of these units (kernels/common/splat.h): what the sixteen roundings of
// numbers of 43 bits at least leave, of places anywhere in the picture.
double fine_place_error(const Frame& frame) {
  const double farthest = 0.5 * std::max(frame.width, frame.height) + 64;
  return 0x1p-17 * largest_unit(frame) + 16 * 0x1p-43 * farthest;
}

// So many roundings count with the logarithm of a peak. A distance over sigma has six: of the
// constant in sigma, of its product with h, of the scale, of its product with that, of the pixel's
// edge and of the quotient. The exponent is its square, which exp takes without another one. Along
// the rows of a panorama two more are those of the latitude's cosine and of sigma over it. On a
// face of a cube six more are those of both tangents, and five of the pixel's secant and the
// quotient.
double roundings_of_fading(const FramePlan& plan) {
  if (plan.is_face_of_cube) return 24;
  return plan.has_ellipses ? 16 : 12;
}

// Of the tolerance, what one splat may spend by its place. Copies of one particle err alike: fifty
// of them may lie upon one another in single precision. Extended numbers err a hundred times less,
// and what they do not hold is drawn again.
constexpr double part_in_single = 0.02, part_in_extended = 0.5;

}  // namespace

PlaceLimits choose_place_limits(const Frame& frame, const FramePlan& plan, double response) {
  // What one splat may spend by its place; errors were a fifth of their bounds
  // (docs/dev/accuracy.md).
  const double allowed = plan.drawn_for_tolerance / std::max(1.0, response);
  PlaceLimits limits;
  set_single_errors(frame, limits);
  limits.share = part_in_single * allowed;
  limits.sharp_width = static_cast<float>(rounding / limits.share);
  limits.most_fading = std::numeric_limits<float>::max();
  // At larger tolerances it takes stars far smaller than a pixel, right at a pixel's edge.
  if (plan.precision != Precision::full) return limits;
  const double share = part_in_extended * allowed;
  const double error = plan.has_fine_places ? fine_place_error(frame) : integer_place_error(frame);
  limits.too_sharp_width = static_cast<float>(error / share);
  limits.most_fading = static_cast<float>(share / (roundings_of_fading(plan) * rounding));
  return limits;
}

}  // namespace splotchcl
