#pragma once

#include <cstddef>
#include <vector>

#include "cells/gaussian.h"
#include "cells/sky_grid.h"

namespace splotchcl {

// How much of a particle lies in a cell.
struct CellShare {
  std::size_t cell = 0;
  double part = 0;
};

// What the integrals over cells are asked to be like.
struct SkyAccuracy {
  double tolerance = 1e-3;  // of what a cell has
  // Over the particle's own density in its middle: below it errors are relative to this.
  double floor = 0;
};

// The angle from a particle's middle beyond which there is less than a hair of what may be wrong.
double reach_that_counts(const GaussianOnSky& particle, const SkyAccuracy& accuracy);

// The cells that a particle reaches, each once or more often. Where the grid has all of the sky,
// the parts are brought to a sum of 1.
void add_shares_on_the_sky(const SkyGrid& grid, const GaussianOnSky& particle,
                           const SkyAccuracy& accuracy, std::vector<CellShare>& shares);

// Shells between rising radii around a point: what each has of a particle at this distance.
void add_shares_in_shells(const std::vector<double>& edges, double distance, double sigma,
                          std::vector<CellShare>& shares);

}  // namespace splotchcl
