#pragma once

#include <cstdint>
#include <optional>

#include "load/missing_sizes.h"
#include "ranks/spread_particles.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// So many particles of one type, whose positions all ranks hold while they search.
constexpr std::uint64_t most_spread_neighbors = std::uint64_t{1} << 24;

// Collective: the smoothing lengths of this rank's particles, [first, first + count) of those of
// all ranks, from neighbours among all of them. Throws DataError, on all ranks, where there are
// more than most_spread_neighbors.
Column find_spread_sizes(SpreadParticles& spread, int type, const Column& own_position,
                         std::uint64_t first, const MissingSizes& how,
                         const std::optional<BoxSides>& periodic_box);

}  // namespace splotchcl
