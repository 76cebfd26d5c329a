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

// Which cells of a level particles lie in.
struct CellCounts {
  std::vector<std::uint64_t> particles;  // of each cell
  // The cells that particles of a stretch of the source lie in: from the first to behind the last.
  // In snapshots whose order is that of space they are few.
  struct Range {
    std::size_t first = 0, end = 0;
    bool meets(std::size_t from, std::size_t to) const { return first < to && from < end; }
  };
  std::vector<Range> of_stretches;
};
CellCounts count_cells(const TreeSource& source, const TreeCube& cube, int level);

// The particles of a level's cells [first, last) in the order of the snapshot, however many threads
// look. Stretches without any are not read.
HeldParticles hold(const TreeSource& source, const TreeCube& cube, int level,
                   const CellCounts& counts, std::size_t first, std::size_t last);

}  // namespace splotchcl
