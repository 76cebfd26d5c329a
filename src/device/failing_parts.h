#pragma once

#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {

// The blocks whose error is above `promise`, in at most four rectangles of whole blocks, in pixels
// of a picture of this size. They do not overlap; none where all blocks keep the promise.
std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height);

}  // namespace splotchcl
