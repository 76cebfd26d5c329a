#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "ranks/spread_particles.h"
#include "smoothing/smoothing_lengths.h"
#include "splotchcl/communicator.h"
#include "splotchcl/load.h"
#include "splotchcl/particles.h"
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

// So many particles of one type, whose positions all ranks hold while they search.
constexpr std::uint64_t most_spread_neighbors = std::uint64_t{1} << 24;

// Collective: the smoothing lengths of this rank's particles, [first, first + count) of those of
// all ranks, from neighbours among all of them. Throws DataError, on all ranks, where there are
// more than most_spread_neighbors.
Column find_spread_sizes(SpreadParticles& spread, int type, const Column& own_position,
                         std::uint64_t first, const MissingSizes& how,
                         const std::optional<BoxSides>& periodic_box);

}  // namespace splotchcl
