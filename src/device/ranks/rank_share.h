#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "device/frame/chunks.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/communicator.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

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

// As long as it lives, this rank has those particles of a frame that it draws, where they are
// spread over ranks; else it does nothing. A frame that is drawn again has the same share.
class FetchedParticles {
 public:
  // Collective.
  FetchedParticles(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);
  ~FetchedParticles();
  FetchedParticles(const FetchedParticles&) = delete;
  FetchedParticles& operator=(const FetchedParticles&) = delete;

 private:
  std::shared_ptr<SpreadParticles> spread_;
};

}  // namespace splotchcl
