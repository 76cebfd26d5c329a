#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "splotchcl/plan.h"

namespace splotchcl {

// Of the few unknowns that filters and stencils are worked out from.
template <std::size_t size>
using SmallVector = std::array<double, size>;
template <std::size_t size>
using SmallMatrix = std::array<SmallVector<size>, size>;

// Of a symmetric, positive definite matrix, by Gauss and Jordan.
template <std::size_t size>
SmallMatrix<size> inverse_of(SmallMatrix<size> matrix) {
  SmallMatrix<size> inverse{};
  for (std::size_t i = 0; i < size; ++i)
    inverse[i][i] = 1;
  for (std::size_t pivot = 0; pivot < size; ++pivot) {
    const double scale = 1 / matrix[pivot][pivot];
    for (std::size_t k = 0; k < size; ++k) {
      matrix[pivot][k] *= scale;
      inverse[pivot][k] *= scale;
    }
    for (std::size_t row = 0; row < size; ++row) {
      if (row == pivot) continue;
      const double part = matrix[row][pivot];
      for (std::size_t k = 0; k < size; ++k) {
        matrix[row][k] -= part * matrix[pivot][k];
        inverse[row][k] -= part * inverse[pivot][k];
      }
    }
  }
  return inverse;
}

template <std::size_t size>
SmallVector<size> times(const SmallMatrix<size>& matrix, const SmallVector<size>& vector) {
  SmallVector<size> product{};
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < size; ++k)
      product[i] += matrix[i][k] * vector[k];
  }
  return product;
}

// Splats of a coarse grid are drawn narrower than they are, and the whole grid is blurred
// once by a Gaussian that makes up for it: exp(-d^2 / (r^2 + b^2)) is exp(-d^2 / r^2)
// convolved with exp(-d^2 / b^2). What a splat costs is so its narrow part's area.

// The sigma^2 by which a grid of splats of sigma >= `smallest_sigma` (pixels of the grid)
// may be blurred, as large as the error allows: sampling what is drawn, and sampling the
// weights of the blur, adds at most `error` of a splat's peak (docs/dev/accuracy.md).
double largest_blur(double smallest_sigma, double error);

// The smallest sigma for which a blur gains anything within the error.
double smallest_blurred_sigma(double error);

// More weights than this no blur has (kernels/resolve): a wider one would cost more than the
// splats' width that it saves.
constexpr int most_blur_weights = 64;

// How far a blur reaches, in pixels: beyond lies less than `error` of the light.
int blur_reach(double sigma2, double error);

// Weights of one axis for the pixels -n .. n, n being its reach, adding up to 1.
std::vector<float> blur_weights(double sigma2, double error);

// The filter for the narrowest splats whose relative error, over both axes and all further
// refinements, stays below `error` of a splat's peak (docs/dev/accuracy.md).
RefinementFilter choose_refinement(double error);

// The filter that does best by splats from `sigma` on, in old pixels, and the largest relative
// error of all refinements of one together.
struct RefinementOfSigma {
  RefinementFilter filter;
  double error = 0;
};
RefinementOfSigma best_refinement(double sigma);

}  // namespace splotchcl
