#pragma once

#include <cmath>

#include "splotchcl/reference.h"

namespace splotchcl::reference {

// The mean of exp(-(t - centre)^2 / sigma^2) for t from i to i + 1: one axis of a pixel's
// mean, since the Gaussian and the pixel are both products of their axes.
inline double mean_over_pixel(double center, double sigma, int i) {
  constexpr double half_sqrt_pi = 0.886226925452758014;
  const double low = (i - center) / sigma;
  const double high = (i + 1 - center) / sigma;
  // Both ends on one side: erf is close to +-1 there and its differences lose the digits
  // that erfc keeps.
  if (low > 0) return half_sqrt_pi * sigma * (std::erfc(low) - std::erfc(high));
  if (high < 0) return half_sqrt_pi * sigma * (std::erfc(-high) - std::erfc(-low));
  return half_sqrt_pi * sigma * (std::erf(high) - std::erf(low));
}

inline double value_at_pixel_center(double center, double sigma, int i) {
  const double distance = (i + 0.5 - center) / sigma;
  return std::exp(-distance * distance);
}

// One axis of the shape in pixel i; the shape is the product of its two axes where the
// kernel does not cut it.
inline double axis_profile(double center, double sigma, int i, Sampling sampling) {
  return sampling == Sampling::mean ? mean_over_pixel(center, sigma, i)
                                    : value_at_pixel_center(center, sigma, i);
}

// The shape of a splat on a face of a cube in pixel (x, y): peak * exp(-squared).
struct FaceShape {
  double peak = 0, squared = 0;
};

inline FaceShape shape_on_face(const Splat& splat, int x, int y) {
  const Splat::OnFace& face = splat.on_face;
  const double dx = x + 0.5 - splat.x, dy = y + 0.5 - splat.y;
  const double across = (x + 0.5 - face.middle_x) / face.focal_pixels;
  const double along = (y + 0.5 - face.middle_y) / face.focal_pixels;
  const double k = 1 + across * across + along * along, g = face.squared_width;
  const double m = g * k + face.footprint, turned = across * dy - along * dx;
  FaceShape shape;
  shape.peak = g * k / m;
  shape.squared = (dx * dx + dy * dy + turned * turned) / (m * face.secant2);
  return shape;
}

// Whether kernel.cut takes the splat's light from the pixel: its centre is farther than
// cut * sigma. With pixel means the pixel that holds the splat's centre keeps its light
// however small the splat is, or all clouds far below a pixel would vanish.
inline bool is_cut(const Splat& splat, int x, int y, const KernelSettings& kernel) {
  if (!kernel.cut) return false;
  if (splat.on_face.focal_pixels > 0)
    return shape_on_face(splat, x, y).squared > *kernel.cut * *kernel.cut;
  const double dx = (x + 0.5 - splat.x) / splat.stretch;
  const double dy = y + 0.5 - splat.y;
  const double radius = *kernel.cut * splat.sigma;
  if (dx * dx + dy * dy <= radius * radius) return false;
  const bool holds_center = std::floor(splat.x) == x && std::floor(splat.y) == y;
  return !(kernel.sampling == Sampling::mean && holds_center);
}

// The layer of a column X of one splat: tau = A X, S = E X phi(tau).
Layer layer_of(const Splat& splat, double column);

// X per unit weight of a splat that may be of a cloud around the camera, in a pixel that looks in
// this direction.
double shape_around(const Splat& splat, int x, int y, const Vec3& direction,
                    const KernelSettings& kernel);

}  // namespace splotchcl::reference
