#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The part by which a splat may err in any channel since its place in the palette, and its
// intensity, are rounded (docs/dev/accuracy.md, "Colors and intensities"): of its brightest
// channel's light, and of the channel's own; the latter is infinite where a channel has no light at
// a knot. By roundings of either sign as an estimate, all of one sign where a bound is asked for
// (FramePlan::certify) and in extended precision. No part of its light bounds what a splat errs by
// whose palette, or intensity, comes close to black elsewhere than where it begins: what is given
// then is an estimate.
struct ColorParts {
  double of_brightest = 0, of_itself = 0;
  bool are_bounds = true;
};
ColorParts parts_of_colors(const Frame& frame, const FramePlan& plan);

}  // namespace splotchcl
