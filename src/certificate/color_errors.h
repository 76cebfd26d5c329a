#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The part of its brightest channel's light by which a splat may err in any channel since its place
// in the palette, and its intensity, are rounded (docs/dev/accuracy.md, "Colors and intensities").
// By roundings of either sign as an estimate, all of one sign where a bound is asked for
// (FramePlan::certify) and in extended precision. An estimate where a palette, or the intensity,
// comes close to black.
double part_of_colors(const Frame& frame, const FramePlan& plan);

}  // namespace splotchcl
