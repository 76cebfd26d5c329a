#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/opencl/device_context.h"

namespace splotchcl {

// The order of splats that lie in parts of their sort keys: the stage `sort` of large frames on a
// processor. A thread sorts a part, so that each stays in a core's caches.
class PartSorter {
 public:
  explicit PartSorter(DeviceContext& device) : device_(device) {}

  SortedSplats sort(KeyedSplats keyed) const;

 private:
  // Parts [first, end), sorted by one launch; their splats together.
  struct Group {
    std::uint32_t first = 0, end = 0;
    std::uint64_t splats = 0;
  };
  std::vector<Group> cut_in_groups(const std::vector<std::uint64_t>& splats_of_parts) const;

  DeviceContext& device_;
};

}  // namespace splotchcl
