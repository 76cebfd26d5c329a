#pragma once

#include <cstdint>

#include "device/frame/records.h"
#include "device/opencl/device_context.h"

namespace splotchcl {

// Stable radix sort of (key, value) pairs on the device: the stage `sort`.
class Sorter {
 public:
  explicit Sorter(DeviceContext& device) : device_(device) {}

  // The splats in the order of ascending keys.
  SortedSplats sort(KeyedSplats keyed) const;
  // The first `count` values in the order of their ascending keys.
  Buffer<std::uint32_t> sort(Buffer<std::uint32_t> keys, Buffer<std::uint32_t> values,
                             std::uint32_t count) const;

 private:
  DeviceContext& device_;
};

}  // namespace splotchcl
