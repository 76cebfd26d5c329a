#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/morton_keys.h"
#include "tree/tree_stretch.h"

namespace splotchcl {

// Of some cells, all their particles in Morton order.
struct HeldParticles {
  std::vector<KeyedParticle> keyed;  // place: among the arrays below
  std::vector<std::uint32_t> place;  // in the snapshot
  std::vector<std::array<float, 3>> position;
  std::vector<float> h;
  std::vector<double> flux;
  std::vector<float> values;  // of all fields
};

// Particles in each cell of a level.
std::vector<std::uint64_t> count_cells(const TreeSource& source, const TreeCube& cube, int level);

// The particles of a level's cells [first, last), `count` of them, in the order of the snapshot
// however many threads look.
HeldParticles hold(const TreeSource& source, const TreeCube& cube, int level, std::size_t first,
                   std::size_t last, std::uint64_t count);

}  // namespace splotchcl
