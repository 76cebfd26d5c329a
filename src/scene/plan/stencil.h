#pragma once

#include "splotchcl/plan.h"

namespace splotchcl {

// Splats of a grid that is blurred need not be Gaussians: whatever weights of a few pixels become
// one when they are blurred serve as well, and the fewest pixels take weights that no formula of a
// narrower Gaussian has (docs/dev/accuracy.md, "Stencils"). So all splats of a grid, whose widths
// differ by little, take the same number of pixels.

// Of a grid that is blurred by `blur_weights` (grid_filters.h), for splats of sigma from `smallest`
// to `largest`, in its pixels. By least squares, such that light is kept.
Stencil make_stencil(double smallest, double largest, const std::vector<float>& blur_weights);

// The sigma^2 of the blur that a stencil for splats from `smallest` on goes with: about as wide as
// they are. A narrower one leaves more to the stencil than it has pixels for, a wider one asks it
// to undo what the blur does.
double blur_of_stencil(double smallest);

// The weights of the pixels from 3 before to 4 behind the one whose center lies at or before a
// splat's by `place`, 0 to 1: as kernels work them out.
std::array<double, stencil_pixels> stencil_weights(const Stencil& stencil, double place,
                                                   double sigma);

}  // namespace splotchcl
