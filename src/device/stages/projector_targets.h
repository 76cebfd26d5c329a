#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/stages/projector.h"

// What the parts of Projector share.
namespace splotchcl {

// Where a launch that counts keys writes.
struct Projector::KeyTargets {
  const Buffer<std::uint32_t>& counts;
  const Buffer<shared::KeyBins>& bins;  // of each block
};

// Where a launch writes.
struct Projector::Targets {
  const Buffer<std::uint32_t>& offsets;  // read: of each block's first splat
  const Buffer<shared::BlockCounts>& counts;
  const SplatMemory& splats;
  const Buffer<std::uint32_t>& keys;
  const Buffer<std::uint16_t>& key_ends;
  // Of splats that are binned as they come.
  const SplatBlocks* blocks = nullptr;
  const KeyTargets* key_counts = nullptr;  // where keys are counted
};

// Of a launch for each component.
struct Projector::AllParticles {
  std::vector<shared::ProjectParameters> components;
  std::vector<std::vector<std::uint32_t>> left_out;
  std::uint32_t blocks = 0, blocks_left_out = 0;
};

}  // namespace splotchcl
