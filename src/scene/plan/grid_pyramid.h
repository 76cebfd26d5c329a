#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The picture's own grid alone.
GridPyramid make_single_grid(const Frame& frame);

// The grids of a sum, from the picture's own pixels to ever coarser ones, for a relative error
// of the splats drawn there. `mean_sigma`: narrower splats need means, which coarse grids do
// not know. `blurs_of_level`: how many grids a coarse level has, where they are blurred; a power
// of two up to most_blurs().
GridPyramid make_pyramid(const Frame& frame, float mean_sigma, double error, int blurs_of_level);

// Pixels of a coarse grid beside what is wanted that its blur looks at, the widest of its level.
int reach_of_blurs(const GridPyramid& pyramid);

// How many grids a coarse level may have in this picture.
int most_blurs(const Frame& frame);

}  // namespace splotchcl
