#include "device/frame/chunks.h"

#include <algorithm>
#include <numeric>

#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

std::vector<SplatChunk> cut(std::uint64_t count, std::uint32_t length) {
  std::vector<SplatChunk> chunks;
  for (std::uint64_t first = 0; first < count; first += length) {
    const auto in_chunk =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(length, count - first));
    chunks.push_back({first, in_chunk, false});
  }
  return chunks;
}

// Of as few equal parts as are no longer than that: buffers of one serve for all.
std::uint32_t equal_length(std::uint64_t count, std::uint32_t longest) {
  const std::uint64_t parts = std::max<std::uint64_t>(1, ceil_divide(count, longest));
  return static_cast<std::uint32_t>(ceil_divide(count, parts));
}

}  // namespace

std::vector<SplatChunk> splat_chunks(std::uint64_t count, int slabs, const DeviceTraits& traits) {
  if (slabs < 1) return cut(count, traits.sorted_chunk);
  const auto parts = static_cast<std::uint64_t>(slabs);
  const auto start_of = [&](std::uint64_t slab) { return count * slab / parts; };
  std::vector<SplatChunk> chunks;
  for (std::uint64_t slab = 0; slab < parts; ++slab) {
    const std::uint64_t first = start_of(slab), end = start_of(slab + 1);
    for (SplatChunk chunk : cut(end - first, equal_length(end - first, traits.sorted_chunk))) {
      chunk.first += first;
      chunks.push_back(chunk);
    }
    if (!chunks.empty()) chunks.back().ends_slab = true;
  }
  return chunks;
}

std::uint64_t particles_per_chunk(std::uint64_t count, const DeviceTraits& traits) {
  const std::uint32_t block = traits.project_block;
  const std::uint64_t blocks = ceil_divide(count, block);
  return std::uint64_t{block} * equal_length(blocks, traits.chunk_length() / block);
}

std::vector<ParticleChunk> particle_chunks(const Frame& frame, const DeviceTraits& traits) {
  std::vector<ParticleChunk> chunks;
  for (std::uint32_t c = 0; c < frame.components.size(); ++c) {
    const std::uint64_t count = frame.components[c].particles.count;
    const auto length = static_cast<std::uint32_t>(particles_per_chunk(count, traits));
    for (const SplatChunk& part : cut(count, length))
      chunks.push_back({c, part.first, part.first + part.count});
  }
  return chunks;
}

std::vector<ChunkBlocks> all_blocks(const std::vector<ParticleChunk>& chunks,
                                    const DeviceTraits& traits) {
  const std::uint32_t length = traits.project_block;
  std::vector<ChunkBlocks> all;
  for (const ParticleChunk& chunk : chunks) {
    all.push_back({chunk, std::vector<std::uint32_t>(ceil_divide(chunk.count(), length))});
    std::iota(all.back().blocks.begin(), all.back().blocks.end(), 0u);
  }
  return all;
}

std::vector<ChunkRange> sum_leaves(std::size_t chunks, const DeviceTraits& traits) {
  constexpr std::size_t most_leaves = 1024;
  const std::size_t length =
      std::max<std::size_t>(traits.leaf_chunks, ceil_divide(chunks, most_leaves));
  std::vector<ChunkRange> leaves;
  for (std::size_t first = 0; first < chunks; first += length)
    leaves.push_back({first, std::min(first + length, chunks)});
  return leaves;
}

std::size_t left_leaves(std::size_t leaves) {
  std::size_t left = 1;
  while (2 * left < leaves)
    left *= 2;
  return left;
}

// A left branch waits, added up, while the right one is drawn.
std::size_t most_held_leaves(std::size_t leaves) {
  if (leaves < 2) return leaves;
  const std::size_t left = left_leaves(leaves);
  return std::max(most_held_leaves(left), 1 + most_held_leaves(leaves - left));
}

std::uint64_t entry_capacity(const FramePlan& plan, const DeviceTraits& traits) {
  const std::uint64_t splats_of_chunk =
      plan.needs_sort() ? traits.sorted_chunk
                        : std::uint64_t{traits.chunk_length()} *
                              static_cast<std::uint64_t>(plan.splats_per_particle);
  return std::max(traits.list_capacity, splats_of_chunk);
}

}  // namespace splotchcl
