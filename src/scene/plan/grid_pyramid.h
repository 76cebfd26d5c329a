#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The picture's own grid alone.
GridPyramid make_single_grid(const Frame& frame);

// The grids of a sum, from the picture's own pixels to ever coarser ones, for a relative error
// of the splats drawn there. `mean_sigma`: narrower splats need means, which coarse grids do
// not know.
GridPyramid make_pyramid(const Frame& frame, float mean_sigma, double error);

}  // namespace splotchcl
