#include "device/frame/chunks.h"

#include <algorithm>

namespace splotchcl {

namespace {

std::vector<SplatChunk> cut(std::uint32_t count, std::uint32_t length) {
  std::vector<SplatChunk> chunks;
  for (std::uint32_t first = 0; first < count; first += chunks.back().count)
    chunks.push_back({first, std::min(length, count - first), false});
  return chunks;
}

}  // namespace

std::vector<SplatChunk> splat_chunks(std::uint32_t count, const DeviceTraits& traits) {
  return cut(count, traits.sorted_chunk);
}

std::vector<SplatChunk> splat_chunks(std::uint32_t count, int slabs, const DeviceTraits& traits) {
  if (slabs < 1) return splat_chunks(count, traits);
  const auto parts = static_cast<std::uint64_t>(slabs);
  const auto start_of = [&](std::uint64_t slab) {
    return static_cast<std::uint32_t>(count * slab / parts);
  };
  std::vector<SplatChunk> chunks;
  for (std::uint64_t slab = 0; slab < parts; ++slab) {
    const std::uint32_t first = start_of(slab), end = start_of(slab + 1);
    for (SplatChunk chunk : splat_chunks(end - first, traits)) {
      chunk.first += first;
      chunks.push_back(chunk);
    }
    if (!chunks.empty()) chunks.back().ends_slab = true;
  }
  return chunks;
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
