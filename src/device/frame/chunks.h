#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// A frame is drawn chunk by chunk. Where chunks begin follows from places in the file or in
// the order alone, never from free memory, from time or from a list that overflowed: the same
// chunks come out wherever the frame is drawn, and with them the same bits.

// Particles [first, end) of one component, in file order: a step of a sum.
struct ParticleChunk {
  std::uint32_t component = 0;
  std::uint64_t first = 0, end = 0;
  std::uint32_t count() const { return static_cast<std::uint32_t>(end - first); }
};
// How long the chunks of a component of `count` particles are, but the last: as few as are no
// longer than a chunk may be, of whole blocks.
std::uint64_t particles_per_chunk(std::uint64_t count, const DeviceTraits& traits);
std::vector<ParticleChunk> particle_chunks(const Frame& frame, const DeviceTraits& traits);

// A chunk, and which of its blocks of DeviceTraits::project_block particles are looked through.
struct ChunkBlocks {
  ParticleChunk chunk;
  std::vector<std::uint32_t> blocks;
};
std::vector<ChunkBlocks> all_blocks(const std::vector<ParticleChunk>& chunks,
                                    const DeviceTraits& traits);

// The light of a sum's chunks is added up leaf by leaf, and leaves by a fixed binary tree, so that
// ranks may share them out to the same bits. A leaf has the same number of chunks whoever draws,
// but for the last; there are never more of them than a tree keeps planes for.
struct ChunkRange {
  std::size_t first = 0, end = 0;
};
std::vector<ChunkRange> sum_leaves(std::size_t chunks, const DeviceTraits& traits);
// Of a node of the tree with so many leaves, two or more: how many its left branch has.
std::size_t left_leaves(std::size_t leaves);
// So many leaves' light, added up or not, a process holds at one time that draws all leaves.
std::size_t most_held_leaves(std::size_t leaves);

// Splats [first, first + count) of the sorted order: a step of an ordered frame.
struct SplatChunk {
  std::uint64_t first = 0;
  std::uint32_t count = 0;
  bool ends_slab = false;  // FramePlan::slabs
};
// In slabs of as many splats each, which chunks do not cross; 0: in none.
std::vector<SplatChunk> splat_chunks(std::uint64_t count, int slabs, const DeviceTraits& traits);

// Entries that lists of a band of the picture have room for. One tile may have all splats of a
// chunk.
std::uint64_t entry_capacity(const FramePlan& plan, const DeviceTraits& traits);

// Where the splats of an ordered frame do not fit into memory together, they are drawn slice by
// slice of their sort keys, nearest first (docs/large.md). Keys have 48 bits.
constexpr int bits_of_key = 48;
constexpr std::uint64_t end_of_keys = std::uint64_t{1} << bits_of_key;
// The bits of a key that number its bin.
constexpr int bits_of_key_bin = 16;
// Of the bins that hold all keys.
constexpr int shift_of_all_keys = bits_of_key - bits_of_key_bin;

// Splats whose keys lie in [first, end).
struct KeyWindow {
  std::uint64_t first = 0, end = end_of_keys;
  std::uint64_t splats = 0;
};

// How many splats each of 2^16 bins of keys has: key >> shift, of the keys in a window.
struct CountedKeys {
  KeyWindow window;
  int shift = shift_of_all_keys;
  std::vector<std::uint64_t> bins;
};

}  // namespace splotchcl
