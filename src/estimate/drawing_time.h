#pragma once

#include "estimate/splat_work.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Seconds on a processor with as many cores, at rates that were measured on two cores of an AMD
// EPYC through PoCL 3.1 (docs/dev/performance.md, Estimates).
double estimate_seconds(const Frame& frame, const FramePlan& plan, const SplatWork& work,
                        int cores);

}  // namespace splotchcl
