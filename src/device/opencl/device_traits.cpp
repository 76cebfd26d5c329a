#include "device/opencl/device_traits.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "kernels/common/group.h"

namespace splotchcl {
namespace {

struct Implementation {
  const char* platform;
  cl_device_type devices;
  Quirks quirks;
};

constexpr Quirks of_pocl_processor = {true, true, true, false, true, true, true};
constexpr Quirks of_other_pocl = {true, false, false, false, false, false, false};
// It is clang, too, and refuses its builtin for prefetching.
constexpr Quirks of_nvidia = {false, false, false, true, false, false, false};

// The first that suits counts; all others keep to the standard, as far as is known.
constexpr Implementation implementations[] = {
    {"Portable Computing Language", CL_DEVICE_TYPE_CPU, of_pocl_processor},
    {"Portable Computing Language", CL_DEVICE_TYPE_ALL, of_other_pocl},
    {"NVIDIA CUDA", CL_DEVICE_TYPE_ALL, of_nvidia},
};

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

}  // namespace

Quirks quirks_of(const compute::device& device) {
  const std::string platform = device.platform().name();
  const auto found = std::find_if(
      std::begin(implementations), std::end(implementations), [&](const Implementation& one) {
        return platform == one.platform && (device.type() & one.devices) != 0;
      });
  return found != std::end(implementations) ? found->quirks : Quirks();
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
  traits.choose_shape(!traits.is_gpu);
  return traits;
}

void DeviceTraits::take_sizes_of_rows() {
  sorts_in_groups = false;
  clears_in_pieces = true;
  draws_slabs = true;
  project_block = interpolate_block = 8192;
  // Every chunk loads and stores all tiles; lists that are much longer leave the caches, and
  // ordered ones, of more and larger entries per splat, do so sooner.
  chunk_blocks = 128;
  // Light is added to light in a few hundredths of the time that eight million particles take.
  leaf_chunks = 8;
  sorted_chunk = 1u << 19;
  bin_blocks = 64;
  sort_blocks = 32;
  segment_length = 8192;
  list_capacity = 3u << 20;
}

void DeviceTraits::take_sizes_of_groups() {
  constexpr std::uint32_t particles_of_leaf = 1u << 23;
  const GroupChunks& chunks =
      *std::find_if(std::begin(group_chunks), std::end(group_chunks),
                    [&](const GroupChunks& size) { return gpu_memory >= size.least_memory; });
  sorts_in_groups = true;
  clears_in_pieces = draws_slabs = false;
  project_block = GROUP_ITEMS;
  interpolate_block = 1;  // neighbors read neighboring memory
  chunk_blocks = chunks.particles / GROUP_ITEMS;
  leaf_chunks = std::max(1u, particles_of_leaf / chunks.particles);
  sorted_chunk = chunks.splats;
  bin_blocks = 64;
  sort_blocks = 4096;
  segment_length = 2048;
  list_capacity = chunks.entries;
}

void DeviceTraits::choose_shape(bool in_rows) {
  // Sizes that a test has set for the shape stay.
  if (project_block != 0 && rows == in_rows) return;
  rows = in_rows;
  if (rows) {
    take_sizes_of_rows();
  } else {
    take_sizes_of_groups();
  }
}

}  // namespace splotchcl
