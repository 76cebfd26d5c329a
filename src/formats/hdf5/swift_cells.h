#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "splotchcl/snapshot.h"

namespace splotchcl {

// Particles of a type that follow each other in a file, and a box that holds them: in the file's
// coordinates, without the snapshot's origin. Axes on which it is not known have no end.
struct ParticleCell {
  std::uint64_t first = 0, count = 0;
  std::array<double, 3> lower{}, upper{};
};

// The cells of one type, as SWIFT writes them into a snapshot of one file, in the file's order and
// with all its particles. Empty where the file has no such table, or one that is not to be trusted:
// without the extents of each cell's particles (older versions; particles drift out of their
// cells), for positions that were compressed with loss, and where particles lie outside of their
// cells' boxes, as where a file was put in another order since: some are looked at.
std::vector<ParticleCell> read_swift_cells(const SnapshotInfo& info, int type);

}  // namespace splotchcl
