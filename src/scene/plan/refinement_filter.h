#pragma once

#include "splotchcl/plan.h"

namespace splotchcl {

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
