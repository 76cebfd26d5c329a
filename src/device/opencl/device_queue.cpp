#include "device/opencl/device_queue.h"

#include <map>

#include "device/opencl/quirks.h"
#include "device/opencl/runtime_lock.h"

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

}  // namespace splotchcl
