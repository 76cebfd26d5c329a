#include "device/ranks/slice_clouds.h"

#include <algorithm>
#include <limits>

namespace splotchcl {

std::vector<CloudRange> clouds_of_slices(const std::vector<std::uint64_t>& keys,
                                         const std::vector<KeySlice>& slices) {
  const auto lies_before = [](std::uint64_t key, const SplatPlace& place) {
    return SplatPlace{key, std::numeric_limits<std::uint64_t>::max()} < place;
  };
  std::vector<CloudRange> ranges;
  std::size_t first = 0;  // also of clouds nearer than all splats
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const auto end = s + 1 < slices.size() ? std::lower_bound(keys.begin(), keys.end(),
                                                              slices[s + 1].begin, lies_before)
                                           : keys.end();
    ranges.push_back({first, static_cast<std::size_t>(end - keys.begin())});
    first = ranges.back().end;
  }
  return ranges;
}

KeySlice with_clouds(KeySlice slice, const CloudRange& clouds) {
  slice.first += clouds.first;
  slice.splats += clouds.end - clouds.first;
  return slice;
}

}  // namespace splotchcl
