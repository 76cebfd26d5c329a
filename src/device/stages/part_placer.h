#pragma once

#include <cstdint>

#include "device/frame/key_parts.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// Puts splats where they stay, in order of the parts that their sort keys lie in, block by block of
// the particles (kernels/project/key_parts.cl): the end of the stage `project` of large ordered
// frames on a processor.
class PartPlacer {
 public:
  // For so many blocks of particles, each with room for `stride` splats.
  PartPlacer(const StageContext& context, const KeyParts& parts, std::uint32_t blocks,
             std::uint32_t stride);

  // Blocks from `first_block` on of all, whose splats lie in `apart`, which has room for theirs
  // alone, as `counts` says of all. They come to lie in `keyed`, which has room for all.
  void place(const KeyedSplats& apart, const Buffer<shared::BlockCounts>& counts,
             std::uint32_t first_block, std::uint32_t block_count, const KeyedSplats& keyed);
  // Where they lie, once all blocks have been placed.
  SplatParts take_parts() { return std::move(parts_); }

 private:
  const StageContext& context_;
  shared::KeyPartParameters parameters_{};
  const Buffer<std::uint8_t> part_of_bin_;
  SplatParts parts_;
};

}  // namespace splotchcl
