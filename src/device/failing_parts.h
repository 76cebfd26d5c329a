#pragma once

#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {

// The blocks whose error is above `promise`, in rectangles of whole blocks, in pixels of a picture
// of this size. They do not overlap; none where all blocks keep the promise. There are 64 at most,
// and one is cut in two only where that saves more pixels than `pixels_of_part`: what another one
// costs besides its own.
std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height, double pixels_of_part);

}  // namespace splotchcl
