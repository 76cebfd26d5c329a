#pragma once

#include <cstddef>

#include "certificate/certificate.h"
#include "device/pipeline.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What a frame is drawn by after a drawing that did not keep its promise.

// The plan of the next drawing of a frame that did not keep its promise in `drawings` of them.
FramePlan next_plan(const Frame& frame, const FramePlan& plan, const Certificate& certificate,
                    std::size_t drawings);

// What a part of the picture takes that is drawn again, besides its pixels, as so many pixels of
// all that are: all particles are projected anew. Where the whole would be drawn in order, in place
// of slabs, its list entries are not known.
double pixels_of_part(const Frame& frame, const FramePlan& plan, const DrawCounts& counts);

// Widths that hardly show in a part may show elsewhere: their splats are drawn nearly as much
// farther as those that need it most.
SplatNeeds with_all_octaves(SplatNeeds needs);

}  // namespace splotchcl
