#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/frame/key_slices.h"

namespace splotchcl {

// Clouds [first, end) of those around the camera, in their order.
struct CloudRange {
  std::size_t first = 0, end = 0;
  std::uint32_t count() const { return static_cast<std::uint32_t>(end - first); }
};

// For each slice of the order the clouds around the camera that lie in it, of which these are the
// keys: each behind the splats of its key. None lies outside.
std::vector<CloudRange> clouds_of_slices(const std::vector<std::uint64_t>& keys,
                                         const std::vector<KeySlice>& slices);

// The slice, in whose order clouds are counted like splats.
KeySlice with_clouds(KeySlice slice, const CloudRange& clouds);

}  // namespace splotchcl
