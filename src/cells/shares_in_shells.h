#pragma once

#include <vector>

#include "cells/shares_on_the_sky.h"

namespace splotchcl {

// Shells between rising radii around a point: what each has of a particle at this distance.
void add_shares_in_shells(const std::vector<double>& edges, double distance, double sigma,
                          std::vector<CellShare>& shares);

}  // namespace splotchcl
