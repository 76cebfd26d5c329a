#pragma once

#include <array>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// About how many positions a reader takes, evenly over the file, to choose an origin.
constexpr int origin_sample_size = 4096;

// The origin from which double-precision positions become single-precision offsets: the
// median of a sample per axis, rounded to single precision. In a zoom simulation most
// particles are in the object of interest, so offsets are smallest, and finest, there.
Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample);

}  // namespace splotchcl
