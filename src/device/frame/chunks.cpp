#include "device/frame/chunks.h"

#include <algorithm>

namespace splotchcl {

std::vector<SplatChunk> splat_chunks(std::uint32_t count, const DeviceTraits& traits) {
  std::vector<SplatChunk> chunks;
  for (std::uint32_t first = 0; first < count; first += chunks.back().count)
    chunks.push_back({first, std::min(traits.chunk_length(), count - first)});
  return chunks;
}

std::vector<ParticleChunk> particle_chunks(const Frame& frame, const DeviceTraits& traits) {
  std::vector<ParticleChunk> chunks;
  for (std::uint32_t c = 0; c < frame.components.size(); ++c) {
    const auto count = static_cast<std::uint32_t>(frame.components[c].particles.count);
    for (const SplatChunk& part : splat_chunks(count, traits))
      chunks.push_back({c, part.first, part.first + part.count});
  }
  return chunks;
}

}  // namespace splotchcl
