#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// What to tell of an index beside the snapshot that is not of its files; empty: nothing.
std::string tell_stale_index(const Snapshot& snapshot);

// Boxes around the particles of a component that takes whole types, one after the other, as it
// places them: from the index beside the snapshot, or from the cells of its own file
// (cell_index.h). Null where there are none, or where they do not tell how large the particles are.
std::shared_ptr<const ParticleBoxes> component_boxes(const Component& component,
                                                     const Snapshot& snapshot,
                                                     const std::vector<int>& types);

// The same boxes of positions that were wrapped around a center, `shift` having been added before.
std::shared_ptr<const ParticleBoxes> wrapped_boxes(const ParticleBoxes& boxes, const Vec3& shift,
                                                   const BoxSides& periodic_box);

}  // namespace splotchcl
