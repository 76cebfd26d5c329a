#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// How bright a frame in which nothing absorbs is likely to be where it is brightest, over a
// twentieth or so of its width, in units of white. A guess from some particles and the brightest
// colors of their palettes, the same for every crop.
double guess_brightness(const Frame& frame);

}  // namespace splotchcl
