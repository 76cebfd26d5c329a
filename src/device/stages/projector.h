#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
#include "device/stages/stage_programs.h"

namespace splotchcl {

struct ChunkKeys {
  ParticleCounts particles;
  std::vector<shared::KeyBins> bins;
  std::uint32_t left_out = 0;  // blocks out of view
};

// Particles to splats: the stage `project`. Each block of particles has room for the splats of all
// of them, so that they are projected once: how many come before is known afterwards.
class Projector {
 public:
  explicit Projector(const StageContext& context);

  // One chunk of a sum, block by block. `particles` are those of its component.
  SplatBlocks project(const ParticleChunk& chunk, const ParticleBuffers& particles) const;
  // What became of the chunk's particles; waits for the device.
  ParticleCounts count(const SplatBlocks& blocks, const ParticleChunk& chunk) const;

  // All particles of all components, with sort keys: what an ordered frame needs.
  KeyedSplats project_all(const std::vector<ParticleBuffers>& particles) const;

  // Counts the keys of a chunk's splats that lie in the window, in bins of 2^shift keys; adds to
  // `key_counts`, which has KEY_BINS.
  ChunkKeys count_keys(const ParticleChunk& chunk, const ParticleBuffers& particles,
                       const KeyWindow& window, int shift,
                       const Buffer<std::uint32_t>& key_counts) const;
  // Writes those splats and their keys from slot `first_slot` on; how many. Blocks of the chunk
  // that `without` says have none: 1, else 0.
  std::uint32_t project_window(const ParticleChunk& chunk, const ParticleBuffers& particles,
                               const KeyWindow& window, const std::vector<std::uint32_t>& without,
                               const KeyedSplats& keyed, std::uint32_t first_slot) const;
  KeyedSplats keyed_memory(std::uint32_t count) const;

 private:
  struct KeyTargets;
  struct Targets;
  struct AllParticles;
  bool has_rows() const { return context_.variant.rows; }
  AllParticles all_of(const std::vector<ParticleBuffers>& particles) const;
  void put_keys_together(const Buffer<std::uint32_t>& keys,
                         const Buffer<shared::BlockCounts>& counts,
                         const std::vector<shared::BlockCounts>& found, std::uint32_t stride,
                         KeyedSplats& keyed) const;
  // The upper bits of keys without the gaps between blocks, or none.
  struct MovedKeys {
    const Buffer<std::uint32_t>&from, &to;
    bool are_moved;
  };
  void list_slots(SplatBlocks& blocks) const;
  void list_slots(std::uint32_t stride, const Buffer<shared::BlockCounts>& counts,
                  const std::vector<std::uint32_t>& first, const MovedKeys& keys,
                  const Buffer<std::uint32_t>& order) const;
  Filling filling_of_slots() const;
  std::vector<ChunkBlocks> chunks_around(const AllParticles& all,
                                         const std::vector<shared::BlockCounts>& found) const;
  Buffer<std::uint16_t> key_ends(std::uint32_t slots, Filling filling = Filling::whole) const;
  std::uint32_t stride_of(const shared::ProjectParameters<float>& parameters) const;
  Buffer<std::byte> splat_memory(std::uint64_t splats, Filling filling = Filling::whole) const;
  void run_by_blocks(Launch& launch, std::size_t blocks) const;
  // Of any order and lists: the same in every frame of the plan.
  Buffer<shared::WidthNeeds> upload_needs() const;
  // Per block of the launch: 0, or out of view and how many of it are bad, and 1; or nothing, where
  // all are projected.
  std::vector<std::uint32_t> left_out_blocks(const shared::ProjectParameters<float>& parameters,
                                             const ParticleBuffers& particles) const;
  void launch(ProjectOutput output, shared::ProjectParameters<float> parameters,
              const ParticleBuffers& particles, const std::vector<std::uint32_t>& left_out,
              const Targets& targets) const;

  const StageContext& context_;
  const Buffer<shared::WidthNeeds> width_needs_;
  // Stand for what a variant of the kernel does not write.
  Buffer<std::uint32_t> unused_;
  Buffer<std::uint16_t> unused_ends_;
};

}  // namespace splotchcl
