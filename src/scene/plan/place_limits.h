#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// For the precision and the tolerance that the plan has by now. `response`: what a relative error
// of every splat does to the picture (error_budget.h).
PlaceLimits choose_place_limits(const Frame& frame, const FramePlan& plan, double response);

}  // namespace splotchcl
