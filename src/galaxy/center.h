#pragma once

#include <array>

#include "splotchcl/image.h"

namespace splotchcl {

// The centre of light in pixels from the left and top of a picture without sky: the centroid
// within circles that shrink around it, so that companions, arms and what lies far out count
// less and less. Throws DataError for a picture without light.
std::array<double, 2> find_center(const Image& picture);

}  // namespace splotchcl
