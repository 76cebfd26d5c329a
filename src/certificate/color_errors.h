#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// The part of its light by which a splat may err since its place in the palette, and its
// intensity, are known to single precision: more the narrower a field's range is beside its values.
// An estimate where a palette, or the intensity, comes close to black (docs/dev/accuracy.md,
// "Checked after drawing").
double part_of_colors(const Frame& frame);

}  // namespace splotchcl
