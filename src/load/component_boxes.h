#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/hdf5/swift_cells.h"
#include "index/snapshot_index.h"
#include "splotchcl/scene.h"
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

// What to tell of an index beside the snapshot that is not of its files; empty: nothing.
std::string tell_stale_index(const Snapshot& snapshot);

// Boxes around the particles of a component that takes whole types, one after the other, as it
// places them: from the index beside the snapshot, or from the cells of its own file
// (index_of_cells). Null where there are none, or where they do not tell how large the particles
// are.
std::shared_ptr<const ParticleBoxes> component_boxes(const Component& component,
                                                     const Snapshot& snapshot,
                                                     const std::vector<int>& types);

// The same boxes of positions that were wrapped around a center, `shift` having been added before.
std::shared_ptr<const ParticleBoxes> wrapped_boxes(const ParticleBoxes& boxes, const Vec3& shift,
                                                   const BoxSides& periodic_box);

}  // namespace splotchcl
