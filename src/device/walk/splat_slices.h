#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/stages/project_parameters.h"
#include "device/stages/projector.h"
#include "device/walk/key_slices.h"

namespace splotchcl {

// In the memory of the device (picture_layout.h).
std::uint64_t splat_capacity(const StageContext& context);

KeyedSplats project_whole(const StageContext& context, const Projector& projector,
                          ParticleStore& particles);

// The splats of an ordered frame, slice by slice of their order, nearest first. One process with
// room for all of them has one slice, and projects it at once. Otherwise keys are counted first,
// and cut into slices: one for each rank or, where these have not room for all at one time, several
// rounds of that. Each rank projects its own share of the particles and gives every splat to the
// rank that has its slice.
class SplatSlices {
 public:
  // All of them outlive it.
  SplatSlices(const StageContext& context, const Projector& projector, ParticleStore& particles,
              FrameRanks& ranks);

  // Collective, first of all; waits for the device. Where particles are too sharp for the plan's
  // precision there is nothing to take.
  void find();
  // Of all ranks; `chunks_around` of this one's.
  const ParticleCounts& particles() const { return counts_; }
  std::uint64_t left_out() const { return left_out_; }      // blocks out of view, of all ranks
  std::uint64_t own_around() const { return own_around_; }  // clouds among this rank's particles

  // Of one slice, projected in one piece.
  bool is_whole() const { return capacity_ == 0; }
  std::size_t rounds() const { return slices_.size() / static_cast<std::size_t>(ranks_.size()); }
  // Whether each rank has room for all splats that it composites a second time.
  bool has_room_for_copies() const;
  // Those of all ranks, round by round.
  const std::vector<KeySlice>& slices() const { return slices_; }
  std::size_t number_of_slice(std::size_t round) const;  // this rank's

  // Collective, once for each round: the splats of this rank's slice, in the order of their
  // particles, behind room for `carried` others, which have the smallest keys, and in front of room
  // for `more`.
  KeyedSplats take(std::size_t round, std::uint32_t carried, std::uint32_t more);

 private:
  bool has_room_for_all() const;
  void find_whole();
  void count_keys();
  Buffer<std::uint32_t> empty_bins() const;
  // Of this rank's chunks, all keys first of all; waits for the device.
  CountedKeys count_here(const KeyWindow& window, int shift);
  CountedKeys count_everywhere(const KeyWindow& window, int shift);
  std::vector<std::uint64_t> count_chunks(const KeyWindow& window);
  KeyedSplats memory_for(const KeySlice& own, std::uint32_t carried, std::uint32_t more) const;
  ParticleBuffers particles_of(std::size_t chunk) const {
    return particles_in_view(context_, particles_, chunks_[chunk]);
  }
  std::uint64_t most_splats_of(std::size_t chunk) const;
  bool has_keys_in(std::size_t chunk, const KeyWindow& window) const;
  // Puts a chunk's splats of the window from slot `slot` on; how many.
  std::uint32_t project(std::size_t chunk, const KeyWindow& window, const KeyedSplats& keyed,
                        std::uint32_t slot) const;
  void project(const KeySlice& own, KeyedSplats& keyed, std::uint32_t first_slot) const;
  void exchange(std::size_t round, const KeyedSplats& keyed, std::uint32_t first_slot);
  std::vector<Communicator::Bytes> share_out(std::size_t round, std::size_t chunk);
  void check(std::uint64_t found, std::uint64_t counted) const;

  const StageContext& context_;
  const Projector& projector_;
  ParticleStore& particles_;
  FrameRanks& ranks_;
  const std::vector<ParticleChunk> chunks_;         // this rank's
  std::vector<std::vector<shared::KeyBins>> bins_;  // of each chunk's blocks: key >> 32
  std::vector<std::uint64_t> chunks_of_ranks_;
  std::uint64_t first_chunk_ = 0;  // number of this rank's first among all
  ParticleCounts counts_;
  std::uint64_t left_out_ = 0, own_around_ = 0;
  std::uint64_t capacity_ = 0;  // of the rank that has least
  std::vector<KeySlice> slices_;
  KeyedSplats whole_;  // of a single slice, until it is taken
};

}  // namespace splotchcl
