#include "device/opencl/device_context.h"

#include "device/opencl/native_exp2.h"
#include "parallel/available_memory.h"

namespace splotchcl {
// A processor shares its memory with files that are mapped and with other programs, a GPU with
// the particles' columns.
DeviceMemory memory_of(const compute::device& device, const DeviceTraits& traits) {
  if (traits.shares_host_memory) return {available_memory() / 4 * 3, ~std::uint64_t{0}};
  const std::uint64_t all = device.global_memory_size();
  return {all / 2, all / 8 * 3};
}

DeviceContext::DeviceContext(const compute::device& chosen)
    : device(chosen),
      opened(open_queue(chosen)),
      context(opened->context),
      queue(opened->queue),
      traits(traits_of(chosen)),
      memory(memory_of(chosen, traits)),
      programs(context),
      pool(context, queue, timer, traits),
      copies(context, queue, timer, traits) {
  if (traits.is_gpu) traits.native_exp2 = native_exp2_serves(*this);
}

void DeviceContext::limit_memory(std::uint64_t bytes) {
  memory.total = bytes;
  pool.expect_at_most(bytes);
}

}  // namespace splotchcl
