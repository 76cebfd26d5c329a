#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/key_windows.h"
#include "device/frame/particle_store.h"
#include "device/frame/stage_context.h"
#include "device/stages/projector.h"

namespace splotchcl {

// Counts the sort keys of chunks of particles without making splats, and remembers of each block
// which keys it has.
class KeyCounter {
 public:
  // All of them outlive it.
  KeyCounter(const StageContext& context, const Projector& projector, ParticleStore& particles,
             std::vector<ParticleChunk> chunks);

  // Of all keys first of all; waits for the device.
  CountedKeys count(const KeyWindow& window, int shift);
  // How many of a window's splats one chunk has.
  std::uint64_t count_in_chunk(std::size_t chunk, const KeyWindow& window);
  const ParticleCounts& particles() const { return counts_; }
  std::uint32_t left_out() const { return left_out_; }  // blocks out of view

  const std::vector<ParticleChunk>& chunks() const { return chunks_; }
  ParticleBuffers particles_of(std::size_t chunk) const;
  std::uint64_t most_splats_of(std::size_t chunk) const;
  // Of each block of the chunk 1 where it has no keys in the window, else 0.
  std::vector<std::uint32_t> blocks_without(std::size_t chunk, const KeyWindow& window) const;
  bool has_keys_in(std::size_t chunk, const KeyWindow& window) const;

 private:
  void note(std::size_t chunk, const ChunkKeys& keys);

  const StageContext& context_;
  const Projector& projector_;
  ParticleStore& particles_;
  const std::vector<ParticleChunk> chunks_;
  std::vector<std::vector<shared::KeyBins>> bins_;  // of each chunk's blocks: key >> 32
  ParticleCounts counts_;
  std::uint32_t left_out_ = 0;
};

}  // namespace splotchcl
