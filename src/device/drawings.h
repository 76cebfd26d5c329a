#pragma once

#include <cstddef>
#include <vector>

#include "certificate/certificate.h"
#include "device/pipeline.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"

namespace splotchcl {

struct DrawnPicture {
  Image image;
  Certificate certificate;
};

// Puts a part that was drawn by itself in its place.
void paste(const DrawnPicture& part, const Rectangle& at, DrawnPicture& whole);

// The largest of these that the picture has: the worst block that kept the promise at first may
// have been drawn again with others.
ErrorParts worst_within(const std::vector<ErrorParts>& candidates, double error_of_promise);

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

// The blocks whose error is above `promise`, in rectangles of whole blocks, in pixels of a picture
// of this size. They do not overlap; none where all blocks keep the promise. There are 64 at most,
// and one is cut in two only where that saves more pixels than `pixels_of_part`: what another one
// costs besides its own.
std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height, double pixels_of_part);

}  // namespace splotchcl
