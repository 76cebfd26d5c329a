#pragma once

#include <array>
#include <vector>

#include "splotchcl/map.h"

namespace splotchcl {

// A piece of a contour: two places in pixels from the top left corner of the map.
using ContourPiece = std::array<std::array<double, 2>, 2>;

// Where the map, linear along the lines between centers of neighboring pixels, has the value: by
// marching squares (Lorensen & Cline 1987 in two dimensions). A saddle is cut by the mean of its
// corners. Squares with a corner that is not a number have none.
std::vector<ContourPiece> contour_pieces(const Map& map, double level);

}  // namespace splotchcl
