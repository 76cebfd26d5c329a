#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// The one place that reads a frame's tolerance: what precision it asks for, and how it is
// shared out.
namespace splotchcl {

struct ErrorBudget {
  Precision precision = Precision::fast;
  bool uses_device_erf = false;
  bool has_sharp_clouds = false;
  ToleranceShares shares;
};

// Looks at a sample of the particles where the tolerance is small: see FramePlan.
ErrorBudget make_error_budget(const Frame& frame, LightPlan light, const PlanOptions& options);

// What a relative error of every splat does to the picture, relative to max(1, I). Light that
// nothing absorbs errs by as much. Otherwise I = q (1 - exp(-x)) for source q and depth x,
// and with x off by a part e the error is e q x exp(-x): at most q / e times exp(-1), and
// never more than e I.
double response_to_splats(double brightest_source, double brightest_background);

}  // namespace splotchcl
