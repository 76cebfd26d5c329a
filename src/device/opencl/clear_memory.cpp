#include "device/opencl/clear_memory.h"

#include <cstddef>

namespace splotchcl {

void clear_memory(DeviceContext& device, const char* stage, const compute::buffer& memory,
                  std::uint64_t first, std::uint64_t bytes) {
  const cl_uint zero = 0;
  device.timer.add(
      stage,
      device.queue.enqueue_fill_buffer(memory, &zero, sizeof(zero), static_cast<std::size_t>(first),
                                       static_cast<std::size_t>(bytes)),
      StageTimer::Kind::serial);
}

}  // namespace splotchcl
