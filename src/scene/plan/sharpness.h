#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// How steeply the picture's clouds rise, the steepest of a sample in fixed steps: the light or
// depth of its pixel per pixel of width. Light that is off by a part of a pixel errs by 0.86
// of that part times this, at most.
double find_sharpness(const Frame& frame);

}  // namespace splotchcl
