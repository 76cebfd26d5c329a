#include "device/opencl/device_traits.h"

namespace splotchcl {

DeviceTraits traits_of(const compute::device& device) {
  DeviceTraits traits;
  traits.is_gpu = (device.type() & CL_DEVICE_TYPE_GPU) != 0;
  traits.shares_host_memory = device.get_info<cl_bool>(CL_DEVICE_HOST_UNIFIED_MEMORY) != 0;
  traits.double_numbers = device.supports_extension("cl_khr_fp64");
  traits.bin_blocks = 64;
  if (traits.is_gpu) {
    traits.rows = false;
    traits.project_block = 256;
    traits.chunk_blocks = 4096;
    traits.sorted_chunk = 1u << 20;
    traits.sort_blocks = 4096;
    traits.segment_length = 4096;
  } else {
    traits.rows = true;
    traits.rows_of_16 = device.get_info<cl_uint>(CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT) >= 16;
    traits.project_block = 8192;
    // Every chunk loads and stores all tiles; lists that are much longer leave the caches, and
    // ordered ones, of more and larger entries per splat, do so sooner.
    traits.chunk_blocks = 128;
    traits.sorted_chunk = 1u << 19;
    traits.sort_blocks = 32;
    traits.segment_length = 8192;
  }
  return traits;
}

}  // namespace splotchcl
