#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Whether a crowd is one of splats that may lie on coarse grids: beside it a pixel may be
// dark, and errs by as much as its sum.
bool is_wide_crowd(const Crowd& crowd);

// `response`: what a relative error of every splat does to the picture (error_budget.h).
SplatLimits choose_splat_limits(const KernelSettings& kernel, const ToleranceShares& shares,
                                const Crowd& crowd, double response);

// `brightest_behind`: the most that can shine through a layer.
LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind);

}  // namespace splotchcl
