#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// Consecutive particles of one part of a snapshot.
struct SampleRange {
  std::size_t part = 0;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

// The particles from which an origin is chosen, some thousands evenly over all. The parts
// are the types' particles in each file, in the order of types and then of files: so the
// same state gives the same sample in any format and in any number of files.
std::vector<SampleRange> sample_ranges(const std::vector<std::uint64_t>& part_sizes);

// The origin from which double-precision positions become single-precision offsets: the
// median of a sample per axis, rounded to single precision. In a zoom simulation most
// particles are in the object of interest, so offsets are smallest, and finest, there.
Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample);

}  // namespace splotchcl
