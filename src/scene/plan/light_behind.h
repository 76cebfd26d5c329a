#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// How bright what lies behind a layer of an ordered frame is likely to reach the eye, in units of
// white: at most 1, and no less than leaves errors of absorption small (plan.h). A guess from the
// sources E / A of some particles and the background, the same for every crop.
double guess_light_behind(const Frame& frame);

}  // namespace splotchcl
