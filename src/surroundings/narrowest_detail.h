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

// Of clouds [first, end) stretches that follow each other, by their ends: where a cut kernel ends
// in the picture every pixel has to be worked out, and the clouds before and behind it need not be
// worked out with it. A single stretch where no kernel ends in the picture.
std::vector<std::size_t> ends_of_stretches(const std::vector<CloudAround>& clouds,
                                           std::size_t first, std::size_t end, const Frame& frame);

}  // namespace splotchcl
