#pragma once

#include "splotchcl/plan.h"

namespace splotchcl {

// The filter for the narrowest splats whose relative error, over both axes and all further
// refinements, stays below `error` of a splat's peak (docs/accuracy.md).
RefinementFilter choose_refinement(double error);

}  // namespace splotchcl
