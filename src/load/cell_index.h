#pragma once

#include <cstdint>
#include <vector>

#include "formats/hdf5/swift_cells.h"
#include "index/snapshot_index.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The index that the cells of a snapshot's own file make, of the types that have such cells
// (swift_cells.h). They do not tell how large particles are.
SnapshotIndex index_of_cells(const Snapshot& snapshot);

// Boxes around blocks of particles, each around the cells that its particles lie in, with positions
// relative to `origin`. Smoothing lengths are 0.
std::vector<ParticleBox> boxes_around_cells(const std::vector<ParticleCell>& cells,
                                            std::uint64_t particles, const Vec3& origin);

// Gives each block of the type the largest of its smoothing lengths. Blocks with a bad one have no
// end.
void add_smoothing_lengths(const Column& lengths, SnapshotIndex::Type& type);

}  // namespace splotchcl
