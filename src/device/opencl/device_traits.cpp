#include "device/opencl/device_traits.h"

#include <algorithm>
#include <iterator>

#include "device/opencl/quirks.h"
#include "kernels/common/group.h"

namespace splotchcl {
namespace {

void take_sizes_of_rows(DeviceTraits& traits) {
  traits.sorts_in_groups = false;
  traits.clears_in_pieces = true;
  traits.draws_slabs = true;
  traits.project_block = traits.interpolate_block = 8192;
  // Every chunk loads and stores all tiles; lists that are much longer leave the caches, and
  // ordered ones, of more and larger entries per splat, do so sooner.
  traits.chunk_blocks = 128;
  // Light is added to light in a few hundredths of the time that eight million particles take.
  traits.leaf_chunks = 8;
  traits.sorted_chunk = 1u << 19;
  traits.bin_blocks = 64;
  traits.sort_blocks = 32;
  traits.segment_length = 8192;
  traits.list_capacity = 3u << 20;
}

// How much a GPU works through at a time. Each chunk launches some twenty kernels, which end when
// the last of its groups does: the fewer chunks, the less of a GPU waits. The lists of a chunk take
// some 60 bytes an entry.
struct GroupChunks {
  std::uint64_t least_memory;  // bytes of the GPU
  std::uint32_t particles, splats;
  std::uint64_t entries;
};
constexpr std::uint64_t gigabyte = 1000000000;
constexpr GroupChunks group_chunks[] = {{30 * gigabyte, 1u << 24, 1u << 24, 64u << 20},
                                        {7 * gigabyte, 1u << 22, 1u << 22, 16u << 20},
                                        {0, 1u << 20, 1u << 21, 8u << 20}};

void take_sizes_of_groups(DeviceTraits& traits) {
  constexpr std::uint32_t particles_of_leaf = 1u << 23;
  const GroupChunks& chunks = *std::find_if(
      std::begin(group_chunks), std::end(group_chunks),
      [&](const GroupChunks& size) { return traits.gpu_memory >= size.least_memory; });
  traits.sorts_in_groups = true;
  traits.clears_in_pieces = traits.draws_slabs = false;
  traits.project_block = GROUP_ITEMS;
  traits.interpolate_block = 1;  // neighbors read neighboring memory
  traits.chunk_blocks = chunks.particles / GROUP_ITEMS;
  traits.leaf_chunks = std::max(1u, particles_of_leaf / chunks.particles);
  traits.sorted_chunk = chunks.splats;
  traits.bin_blocks = 64;
  traits.sort_blocks = 4096;
  traits.segment_length = 2048;
  traits.list_capacity = chunks.entries;
}

}  // namespace

Choices lanes_of(const DeviceTraits& traits) {
  return lanes_of(traits.rows);
}

std::string shape_name(const DeviceTraits& traits) {
  return std::string(traits.rows ? "rows" : "groups") + (traits.rows_of_16 ? " of 16" : "");
}

DeviceTraits traits_of(const compute::device& device) {
  DeviceTraits traits;
  traits.is_gpu = (device.type() & CL_DEVICE_TYPE_GPU) != 0;
  traits.shares_host_memory = device.get_info<cl_bool>(CL_DEVICE_HOST_UNIFIED_MEMORY) != 0;
  traits.large_pages = quirks_of(device).takes_large_pages;
  traits.double_numbers = device.supports_extension("cl_khr_fp64");
  traits.largest_buffer = device.max_memory_alloc_size();
  if (traits.is_gpu) traits.gpu_memory = device.global_memory_size();
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
