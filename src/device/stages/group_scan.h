#pragma once

#include <cstdint>

#include "device/opencl/device_context.h"

namespace splotchcl {

// Exclusive sums of lists in the shape for GPUs, in as many steps as their length has factors of
// 2048: reduce, scan, add, of which the middle one is left out where it has no more than 2048 sums:
// each group adds up those before it. No list is walked by a single work-item.
class GroupScan {
 public:
  explicit GroupScan(DeviceContext& device);

  // In place: values[i] becomes the sum of those before it, and values[count], for which there is
  // room, that of all. Below 2^32; `stage` as in Launch.
  void scan(const char* stage, const Buffer<std::uint32_t>& values, std::uint32_t count) const;

 private:
  DeviceContext& device_;
  Program program_;
  Buffer<std::uint32_t> nothing_;  // what is before the first stretch
};

}  // namespace splotchcl
