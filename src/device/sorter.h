#pragma once

#include <cstdint>

#include "device/device_context.h"

namespace splotchcl {

// Stable radix sort of (key, value) pairs on the device: the stage `sort`.
class Sorter {
 public:
  explicit Sorter(DeviceContext& device) : device_(device) {}

  // Sorts the first `count` pairs of the two buffers by ascending key. They are swapped
  // with buffers of the same size; what comes back holds the result.
  struct Pairs {
    compute::buffer keys, values;
  };
  Pairs sort(const Pairs& pairs, std::uint32_t count);

  // Gives up the keys and all scratch; pairs still held by the caller stay valid.
  void release_buffers();

 private:
  DeviceContext& device_;
};

}  // namespace splotchcl
