#include "device/frame/chunks.h"

#include <algorithm>

namespace splotchcl {

namespace {

std::vector<SplatChunk> cut(std::uint32_t count, std::uint32_t length) {
  std::vector<SplatChunk> chunks;
  for (std::uint32_t first = 0; first < count; first += chunks.back().count)
    chunks.push_back({first, std::min(length, count - first)});
  return chunks;
}

}  // namespace

std::vector<SplatChunk> splat_chunks(std::uint32_t count, const DeviceTraits& traits) {
  return cut(count, traits.sorted_chunk);
}

std::vector<ParticleChunk> particle_chunks(const Frame& frame, const DeviceTraits& traits) {
  std::vector<ParticleChunk> chunks;
  for (std::uint32_t c = 0; c < frame.components.size(); ++c) {
    const auto count = static_cast<std::uint32_t>(frame.components[c].particles.count);
    for (const SplatChunk& part : cut(count, traits.chunk_length()))
      chunks.push_back({c, part.first, part.first + part.count});
  }
  return chunks;
}

}  // namespace splotchcl
