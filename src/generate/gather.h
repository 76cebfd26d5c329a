#pragma once

#include <vector>

#include "generate/waves.h"

namespace splotchcl {

// How many of `places` (in the periodic unit cube) lie near each point of a grid, evenly
// shared between the eight nearest, then averaged over a Gaussian of this width in cells.
PeriodicGrid smoothed_density(const std::vector<Vec3>& places, int side, double width);

// A step from `place` towards denser matter: where a Gaussian of `width` cells around it
// has its centre of mass. Sheets become filaments and filaments sharper.
Vec3 step_uphill(const PeriodicGrid& density, const Vec3& place, double width);

}  // namespace splotchcl
