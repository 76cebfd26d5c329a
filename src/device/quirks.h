#pragma once

#include <cstdint>
#include <string>

#include "device/opencl.h"

namespace splotchcl {

// What differs between devices, decided by their type alone, so that the same device
// always does the same sums in the same order.
struct DeviceTraits {
  bool is_gpu = false;
  bool shares_host_memory = false;  // buffers may lie in the caller's own memory
  bool rows = true;                 // composite rows of float8, not groups
  bool double_numbers = false;      // exact numbers are double precision, not pairs (exact.cl)
  // Flags that every program gets. Relaxed math is unfit for keys and for expm1.
  const char* build_options = "";
  std::uint32_t project_block = 0;   // particles per work-item of a projection
  std::uint32_t chunk_blocks = 0;    // such blocks per chunk
  std::uint32_t sort_blocks = 0;     // blocks of the radix sort
  std::uint32_t segment_length = 0;  // entries of a tile's list per work-item
};

// The #defines that choose what exact numbers are.
std::string exact_number_defines(const DeviceTraits& traits);

DeviceTraits traits_of(const compute::device& device);

}  // namespace splotchcl
