#pragma once

#include "scene/constants.h"

namespace splotchcl {

// How a pixel responds to a Gaussian of standard deviation s along each axis, the mean of it over a
// square pixel, and how its derivatives do: the squares of their Frobenius norms, added up over all
// places of the Gaussian, in pixels.
struct PixelResponse {
  double value = 0, first = 0, second = 0, third = 0, fourth = 0;
  double area = 0;  // pixels: of a Gaussian with the sum of value and its largest square
};

// That of a Gaussian as wide as the pixel and the Gaussian together, whose n-th derivatives add up
// to n! / (4 pi w^(2 n + 2)), with w^2 = s^2 + 1/12 (docs/dev/accuracy.md). From s = 0.25 on
// within a fifth of what a square pixel gives; narrower ones see its edges.
inline PixelResponse pixel_response(double variance_pixels2) {
  const double w2 = variance_pixels2 + 1.0 / 12;
  PixelResponse response;
  response.value = 1 / (4 * pi * w2);
  response.first = response.value / w2;
  response.second = 2 * response.first / w2;
  response.third = 3 * response.second / w2;
  response.fourth = 4 * response.third / w2;
  response.area = pi * w2;
  return response;
}

}  // namespace splotchcl
