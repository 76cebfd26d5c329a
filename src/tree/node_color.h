#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tree/tree_parts.h"

namespace splotchcl {

// What the fields of a node's members make of its light.
struct NodeColor {
  std::array<float, 3> mean = {1, 1, 1};
  double variance = 0;   // of the mean, since only some members are known
  double deviation = 0;  // of members
  // Length of the mean of their colors times their ways from the centroid, in cells, where known.
  std::optional<double> dipole;
};

NodeColor node_color(const TreePart& part, const TreeLevel& level, std::uint64_t node);

}  // namespace splotchcl
