#include "device/ranks/slice_part.h"

#include <algorithm>

namespace splotchcl {
namespace {

// The first chunk that ends behind this splat: of splats before it nothing is left over in others.
std::size_t chunk_at(std::uint64_t splat, const std::vector<SplatChunk>& chunks) {
  const auto found = std::upper_bound(chunks.begin(), chunks.end(), splat,
                                      [](std::uint64_t place, const SplatChunk& chunk) {
                                        return place < chunk.first + chunk.count;
                                      });
  return static_cast<std::size_t>(found - chunks.begin());
}

}  // namespace

SlicePart part_of(const KeySlice& slice, const std::vector<SplatChunk>& chunks) {
  const std::uint64_t end = slice.first + slice.splats;
  const auto first_of = [&](std::size_t chunk, std::uint64_t if_behind_all) {
    return chunk < chunks.size() ? chunks[chunk].first : if_behind_all;
  };
  SlicePart part;
  part.first_chunk = chunk_at(slice.first, chunks);
  part.end_chunk = chunk_at(end, chunks);
  part.first = first_of(part.first_chunk, slice.first);
  part.carried = static_cast<std::uint32_t>(slice.first - part.first);
  part.own = static_cast<std::uint32_t>(slice.splats);
  part.passed_on = static_cast<std::uint32_t>(end - first_of(part.end_chunk, end));
  return part;
}

}  // namespace splotchcl
