#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

GridPyramid make_single_grid(const Frame& frame);

struct PyramidNeeds {
  float mean_sigma = 0;  // narrower splats need means, which only the picture's own grid knows
  double error = 0;      // of splats on other grids, as a part of their peak
  // How many grids a level has, where they are blurred; a power of two up to most_blurs(), of which
  // there are as many where splats are stencils.
  int blurs_of_level = 2;
  // Whether splats on blurred grids may be stencils, which are not cut, and if so from which level
  // on there are such grids: 0 or 1.
  bool stencils = false;
  int first_level = 1;
};

// The narrowest splats that are stencils, or nearly: they are a little wider where the error is
// small.
constexpr double about_narrowest_stencil = 2.2;  // pixels

// The grids of a sum, from the picture's own pixels to ever coarser ones.
GridPyramid make_pyramid(const Frame& frame, const PyramidNeeds& needs);

// Pixels of a coarse grid beside what is wanted that its blur looks at, the widest of its level.
int reach_of_blurs(const GridPyramid& pyramid);

// Of a coarse level. MOST_BLURS of kernels (grid.h).
constexpr int most_grids_of_level = 4;

// How many grids a coarse level may have in this picture.
int most_blurs(const Frame& frame);

}  // namespace splotchcl
