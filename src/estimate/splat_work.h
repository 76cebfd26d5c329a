#pragma once

#include "device/frame/variant.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How much there is to do for the splats of a frame.
struct SplatWork {
  double splats = 0;        // that reach the picture
  double tile_entries = 0;  // summed over the tiles that they touch
  double row_parts = 0;     // eight pixels of a row each
};

// From a sample of the particles, with the plan's extents and grids, as kernels/project/limits.cl
// chooses them. Tiles that become opaque early are counted as if they did not.
SplatWork estimate_splat_work(const Frame& frame, const FramePlan& plan, const Variant& variant);

}  // namespace splotchcl
