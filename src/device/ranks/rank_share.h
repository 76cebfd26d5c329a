#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/chunks.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// What each of `ranks` ranks takes of a frame: stretches of its particles, which follow from their
// numbers alone.

// Of `count` leaves of a sum. Rank 0 has the first.
ChunkRange leaves_of_rank(std::size_t count, int rank, int ranks);
int owner_of_leaf(std::size_t leaf, std::size_t count, int ranks);

// Of all particles of all components, in chunks of whole blocks: where order matters, what becomes
// of a particle does not depend on the others of its chunk.
std::vector<ParticleChunk> particles_of_rank(const Frame& frame, const DeviceTraits& traits,
                                             int rank, int ranks);

}  // namespace splotchcl
