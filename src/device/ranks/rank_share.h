#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/frame/chunks.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/communicator.h"
#include "splotchcl/error.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

struct RankWork {
  std::uint64_t particles = 0;   // that it has projected
  std::uint64_t splats = 0;      // that it has composited
  std::uint64_t sent_bytes = 0;  // of splats and planes, to others
};

struct FrameRanks {
  Communicator& all;
  RankWork work;

  int rank() const { return all.rank(); }
  int size() const { return all.size(); }
};

// The one rank of a frame that one process draws: what all ranks have is what it has itself.
class LoneRank final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int rank_on_host() const override { return 0; }
  int size_on_host() const override { return 1; }
  std::string host() const override { return {}; }
  void broadcast(void*, std::size_t, int) override {}
  std::vector<Bytes> gather(const Bytes& own) override { return {own}; }
  void add_up(std::vector<std::uint64_t>&) override {}
  std::vector<Bytes> exchange(std::vector<Bytes> parts) override { return parts; }
  void send(const void*, std::size_t, int) override { throw_alone(); }
  void receive(void*, std::size_t, int) override { throw_alone(); }
  [[noreturn]] void abort(int code) override { std::_Exit(code); }

 private:
  [[noreturn]] static void throw_alone() {
    throw Error(
        "found a message to another process where one draws alone, expected none; please "
        "report this");
  }
};

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
