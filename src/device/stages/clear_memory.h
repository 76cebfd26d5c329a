#pragma once

#include <cstdint>

#include "device/opencl/device_context.h"

namespace splotchcl {

// Sets `bytes` from `first` on to 0, both multiples of 4, as a part of that stage.
void clear_memory(DeviceContext& device, const char* stage, const compute::buffer& memory,
                  std::uint64_t first, std::uint64_t bytes);

}  // namespace splotchcl
