#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Even light of splats on a lattice, seen along its axis, loses a row of them beyond each side
// of their squares: up to this times exp(-k^2) of itself (docs/accuracy.md).
constexpr double lattice_rows = 2;

// By how much of its peak the widened center value of a splat errs at most, from sigma 2 on.
double center_value_error(double sigma_pixels);

// `response`: what a relative error of every splat does to the picture (error_budget.h).
SplatLimits choose_splat_limits(const KernelSettings& kernel, const ToleranceShares& shares,
                                LightPlan light, double response);

// `brightest_behind`: the most that can shine through a layer.
LayerLimits choose_layer_limits(const ToleranceShares& shares, LightPlan light,
                                double brightest_behind);

}  // namespace splotchcl
