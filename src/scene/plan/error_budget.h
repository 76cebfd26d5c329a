#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// The one place that reads a frame's tolerance: what precision it asks for, and how it is
// shared out.
namespace splotchcl {

struct ErrorBudget {
  Precision precision = Precision::fast;
  bool has_fine_places = false;
  bool adds_small_blocks = false;
  ToleranceShares shares;
};

// `drawn_for`: the tolerance that is shared out, at most the frame's, which is promised.
// `coarse_grids`: whether there may be some; in an ordered frame they hold slabs.
ErrorBudget make_error_budget(const Frame& frame, double drawn_for, LightPlan light,
                              bool coarse_grids);

// Of the highest precision, which promises extended_tolerance.
ErrorBudget make_extended_budget();

// What a relative error of every splat does to the picture, relative to max(1, I). Light that
// nothing absorbs errs by as much. Otherwise light b behind a depth x off by a part of itself
// errs by that part of x b exp(-x): of max(1, b exp(-x)) this is at most b / e, or where b is
// above e, log(b), at the depth where it has faded to 1. Where everything has one source q
// in front of the background b the largest of x |b - q| exp(-x) / max(1, I) over x is less.
double response_to_splats(LightPlan light, double brightest_source, double brightest_background);

// The same of what the check after drawing does not know. Where stars that only emit stand among
// absorbing gas, nothing says how bright they are behind it: a thousand times white is allowed for.
double response_to_unchecked(LightPlan light, double brightest_source, double brightest_background);

}  // namespace splotchcl
