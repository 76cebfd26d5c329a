#pragma once

#include <array>
#include <cstdint>

#include "tree/tree_stretch.h"

namespace splotchcl {

// Of the particles that can be drawn.
struct SourceExtent {
  std::array<float, 3> lower{}, upper{};
  std::uint64_t good = 0;
};
SourceExtent find_extent(const TreeSource& source);

// A little larger than the particles' box, so that all lie within.
TreeCube cube_around(const SourceExtent& extent);

}  // namespace splotchcl
