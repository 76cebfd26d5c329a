#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// `response`: what a relative error of every splat does to the picture (error_budget.h).
PlaceLimits choose_place_limits(const Frame& frame, Precision precision, double response);

}  // namespace splotchcl
