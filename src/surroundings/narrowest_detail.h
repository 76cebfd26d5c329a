#pragma once

#include <cstddef>
#include <vector>

#include "surroundings/cloud_around.h"

namespace splotchcl {

// No detail of clouds [first, end) is narrower in the picture than exp(-x^2 / n^2) with this n, in
// pixels. Seen from u sigma away a cloud is 1 / u wide in radians, from within it about 1. Less
// than a pixel where a kernel that is cut ends.
double narrowest_detail(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                        const Frame& frame);

}  // namespace splotchcl
