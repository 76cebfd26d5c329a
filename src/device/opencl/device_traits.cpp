#include "device/opencl/device_traits.h"

#include "device/opencl/program_text.h"
#include "kernels/common/group.h"

namespace splotchcl {
namespace {

void take_sizes_of_rows(DeviceTraits& traits) {
  traits.project_block = 8192;
  // Every chunk loads and stores all tiles; lists that are much longer leave the caches, and
  // ordered ones, of more and larger entries per splat, do so sooner.
  traits.chunk_blocks = 128;
  // Light is added to light in a few hundredths of the time that eight million particles take.
  traits.leaf_chunks = 8;
  traits.sorted_chunk = 1u << 19;
  traits.bin_blocks = 64;
  traits.sort_blocks = 32;
  // A part is sorted in a core's caches, and blocks that are projected at a time lie in all cores'.
  // The splats of fewer parts are sorted as fast all at once (docs/tuning.md).
  traits.splats_of_part = 1u << 15;
  traits.fewest_parts = 96;
  traits.blocks_apart = 64;
  traits.segment_length = 8192;
  traits.list_capacity = 3u << 20;
}

void take_sizes_of_groups(DeviceTraits& traits) {
  traits.project_block = GROUP_ITEMS;
  traits.chunk_blocks = 4096;
  traits.leaf_chunks = 8;
  // Every chunk launches some twenty kernels.
  traits.sorted_chunk = 1u << 21;
  traits.bin_blocks = 64;
  traits.sort_blocks = 4096;
  traits.segment_length = 4096;
  traits.list_capacity = 8u << 20;
}

}  // namespace

DeviceTraits traits_of(const compute::device& device) {
  DeviceTraits traits;
  traits.is_gpu = (device.type() & CL_DEVICE_TYPE_GPU) != 0;
  traits.shares_host_memory = device.get_info<cl_bool>(CL_DEVICE_HOST_UNIFIED_MEMORY) != 0;
  // Other processors' runtimes may want whole pages, and make a copy of what is not.
  traits.large_pages = (device.type() & CL_DEVICE_TYPE_CPU) != 0 && is_pocl(device);
  traits.double_numbers = device.supports_extension("cl_khr_fp64");
  traits.largest_buffer = device.max_memory_alloc_size();
  traits.threads = device.compute_units();
  traits.rows_of_16 = device.get_info<cl_uint>(CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT) >= 16;
  choose_shape(traits, !traits.is_gpu);
  return traits;
}

void choose_shape(DeviceTraits& traits, bool rows) {
  // Sizes that a test has set for the shape stay.
  if (traits.project_block != 0 && traits.rows == rows) return;
  traits.rows = rows;
  if (rows) {
    take_sizes_of_rows(traits);
  } else {
    take_sizes_of_groups(traits);
  }
}

}  // namespace splotchcl
