#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How many clouds lie so close upon one another, before something darker, that the ends of
// their discs add up in one pixel: 1 where there are no more than the budget foresees
// (docs/accuracy.md). An estimate from a sample of the frame's particles in fixed steps: the
// same in every run and on every device.
Crowd find_crowd(const Frame& frame);

}  // namespace splotchcl
