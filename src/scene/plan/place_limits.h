#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// `tolerance`: what the frame is drawn for. `response`: what a relative error of every splat does
// to the picture (error_budget.h).
PlaceLimits choose_place_limits(const Frame& frame, double tolerance, Precision precision,
                                double response);

}  // namespace splotchcl
