#pragma once

#include <cstddef>
#include <vector>

namespace splotchcl {

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

}  // namespace splotchcl
