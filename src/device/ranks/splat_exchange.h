#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/key_slices.h"
#include "device/ranks/rank_work.h"
#include "device/stages/key_counter.h"
#include "device/stages/projector.h"

namespace splotchcl {

// The splats of an ordered frame among ranks: each projects its own share of the particles and
// gives every splat to the rank whose slice of the order it lies in, nearest first. Where ranks
// have not room for all of them at one time that happens in rounds, one slice for each rank.
class SplatExchange {
 public:
  // All of them outlive it.
  SplatExchange(const StageContext& context, const Projector& projector, ParticleStore& particles,
                FrameRanks& ranks);

  // Collective, first of all. Where particles are too sharp there is nothing to exchange.
  void count_keys();
  const ParticleCounts& particles() const { return counts_; }  // of all ranks
  std::uint64_t left_out() const { return left_out_; }         // blocks out of view, of all ranks
  // This rank's own particles, and how many of these clouds are around the camera.
  const std::vector<ParticleChunk>& chunks() const { return counter_.chunks(); }
  std::uint64_t own_around() const { return own_around_; }

  std::size_t rounds() const { return slices_.size() / static_cast<std::size_t>(ranks_.size()); }
  // Whether each rank has room for all splats that it composites a second time.
  bool has_room_for_copies() const;
  // Those of all ranks, round by round.
  const std::vector<KeySlice>& slices() const { return slices_; }
  std::size_t number_of_slice(std::size_t round, int rank) const;
  // The keys of all slices of a round.
  KeyWindow window(std::size_t round) const;
  // Collective: the splats of this rank's slice, in the order of their particles, behind room for
  // `carried` others, which have the smallest keys, and in front of room for `more`.
  KeyedSplats take(std::size_t round, std::uint32_t carried, std::uint32_t more);

 private:
  const KeySlice& slice(std::size_t round, int rank) const;
  CountedKeys count_everywhere(const KeyWindow& window, int shift);
  std::vector<std::uint64_t> count_chunks(const KeyWindow& window);
  std::vector<Communicator::Bytes> share_out(std::size_t round, std::size_t chunk);
  void put_together(std::vector<std::vector<Communicator::Bytes>>& received,
                    const KeyedSplats& keyed, std::uint32_t carried) const;

  const StageContext& context_;
  const Projector& projector_;
  FrameRanks& ranks_;
  KeyCounter counter_;
  std::vector<std::uint64_t> chunks_of_ranks_;
  std::uint64_t first_chunk_ = 0;  // number of this rank's first among all
  ParticleCounts counts_;
  std::uint64_t left_out_ = 0, own_around_ = 0;
  std::uint64_t capacity_ = 0;  // of the rank that has least
  std::vector<KeySlice> slices_;
};

}  // namespace splotchcl
