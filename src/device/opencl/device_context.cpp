#include "device/opencl/device_context.h"

#include <map>

#include "device/opencl/native_exp2.h"
#include "device/opencl/quirks.h"
#include "device/opencl/runtime_lock.h"
#include "parallel/available_memory.h"

namespace splotchcl {

DeviceQueue::DeviceQueue(const compute::device& device)
    : context(device), queue(context, device, compute::command_queue::enable_profiling) {}

std::shared_ptr<DeviceQueue> open_queue(const compute::device& device) {
  const auto lock = lock_runtime();
  if (!quirks_of(device).needs_one_queue) return std::make_shared<DeviceQueue>(device);
  static std::map<cl_device_id, std::weak_ptr<DeviceQueue>> queues;
  std::weak_ptr<DeviceQueue>& known = queues[device.id()];
  std::shared_ptr<DeviceQueue> shared = known.lock();
  if (!shared) known = shared = std::make_shared<DeviceQueue>(device);
  return shared;
}

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
