#pragma once

#include <functional>
#include <optional>
#include <string>

#include "smoothing/smoothing_lengths.h"
#include "splotchcl/communicator.h"
#include "splotchcl/load.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// How smoothing lengths are found that a file does not have.
struct MissingSizes {
  int neighbors = particles_in_sphere;
  bool is_cached = false;
  LoadProgress progress;
};

MissingSizes missing_sizes(const Scene& scene, const LoadProgress& progress);

// Each of these ranks, which have the same positions, searches for a part of the particles; null:
// this process searches for all.
SearchShare search_share(Communicator* ranks);

// From the neighbours of each particle of a type, or from the file beside the snapshot where
// an earlier search has left them. Collective, where ranks share the snapshot. `say` takes what the
// user should know.
Column find_sizes_by_neighbors(const Snapshot& snapshot, int type, const Column& position,
                               const std::optional<BoxSides>& periodic_box, const MissingSizes& how,
                               const std::function<void(const std::string&)>& say);

}  // namespace splotchcl
