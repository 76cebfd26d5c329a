#pragma once

#include <cstdint>

#include "device/opencl/opencl.h"

namespace splotchcl {

// What differs between devices, decided by their type and by the shape of the kernels, for GPUs
// also by their memory, so that the same device always does the same sums in the same order.
struct DeviceTraits {
  bool is_gpu = false;
  bool shares_host_memory = false;   // buffers may lie in the caller's own memory
  bool large_pages = false;          // working memory is the host's, on large pages (large_pages.h)
  bool rows = true;                  // the shape: eight lanes, rows; not work-groups
  bool rows_of_16 = false;           // registers hold sixteen floats
  bool double_numbers = false;       // cl_khr_fp64
  std::uint64_t largest_buffer = 0;  // bytes
  std::uint64_t gpu_memory = 0;      // bytes, free or not; 0: no GPU
  std::uint32_t threads = 1;         // only memory follows from them
  std::uint32_t project_block = 0;   // particles per work-item of a projection, or per group
  std::uint32_t chunk_blocks = 0;    // such blocks per chunk of a sum
  std::uint32_t leaf_chunks = 0;     // such chunks per leaf of a sum (chunks.h)
  std::uint32_t sorted_chunk = 0;    // splats per chunk where they are sorted
  std::uint32_t bin_blocks = 0;      // blocks that a chunk's splats are binned in, in order
  std::uint32_t sort_blocks = 0;     // blocks of the radix sort
  std::uint32_t segment_length = 0;  // entries of a tile's list per work-item
  std::uint64_t list_capacity = 0;   // entries of all lists of a band of the picture
  std::uint32_t chunk_length() const { return project_block * chunk_blocks; }
};

// With the shape that suits the device.
DeviceTraits traits_of(const compute::device& device);

// Gives the traits the other shape, with all sizes that go with it, if they have not that one.
void choose_shape(DeviceTraits& traits, bool rows);

}  // namespace splotchcl
