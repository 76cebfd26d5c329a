#pragma once

#include <array>

namespace splotchcl {

// How a grid is interpolated to half its pixel size: cell-centred, so every new pixel lies
// a quarter of a pixel beside an old one. The weights are those of old pixels -4 .. 5 for a
// new pixel right of old pixel 0, and mirrored for one left of it; they add up to 1.
struct RefinementFilter {
  std::array<double, 10> weights = {0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  double smallest_sigma = 0;  // narrowest splat, in old pixels, that it carries
};

// The filter for the narrowest splats whose relative error, over both axes and all further
// refinements, stays below `error` of a splat's peak (docs/accuracy.md).
RefinementFilter choose_refinement(double error);

}  // namespace splotchcl
