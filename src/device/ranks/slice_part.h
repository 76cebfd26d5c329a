#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/key_slices.h"

namespace splotchcl {

// What a rank composites: the chunks of the order that end in its slice. What a chunk that ends
// behind the slice has of it goes to the next rank, which carries it in front of its own.
struct SlicePart {
  std::uint64_t first = 0;    // splat of the order: the first that is carried, or its own
  std::uint32_t carried = 0;  // splats of slices before
  std::uint32_t own = 0;
  std::size_t first_chunk = 0, end_chunk = 0;  // of the order
  std::uint32_t passed_on = 0;                 // the last ones of both

  std::uint32_t splats() const { return carried + own; }
  std::uint32_t composited() const { return splats() - passed_on; }
};

SlicePart part_of(const KeySlice& slice, const std::vector<SplatChunk>& chunks);

}  // namespace splotchcl
