#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/opencl/buffer_pool.h"
#include "device/opencl/device_queue.h"
#include "device/opencl/device_traits.h"
#include "device/opencl/launch_record.h"
#include "device/opencl/opencl.h"
#include "device/opencl/program_cache.h"
#include "device/opencl/stage_timer.h"
#include "device/opencl/staged_copies.h"

namespace splotchcl {

// Throws DeviceError when there is no device, UsageError when none has that name. Of several alike
// it is number `which`, round and round.
compute::device choose_device(const std::string& part_of_name, int which = 0);

// Its platform's name and its own, of which users may write a part.
std::string full_name_of(const compute::device& device);

// What may be in use at one time, in bytes.
struct DeviceMemory {
  std::uint64_t total = 0;    // of working memory: planes, splats, keys, lists
  std::uint64_t columns = 0;  // of particles' columns, on a device with memory of its own
};

// What a device has room for beside all else that uses its memory.
DeviceMemory memory_of(const compute::device& device, const DeviceTraits& traits);

// One device with its queue and what all stages share.
struct DeviceContext {
  explicit DeviceContext(const compute::device& chosen);

  // So much working memory is to be in use at one time, whatever the device has.
  void limit_memory(std::uint64_t bytes);

  compute::device device;
  std::shared_ptr<DeviceQueue> opened;  // keeps a queue that is shared, of which these are copies
  compute::context context;
  compute::command_queue queue;  // in order
  DeviceTraits traits;
  DeviceMemory memory;
  ProgramCache programs;
  StageTimer timer;
  BufferPool pool;
  StagedCopies copies;
  std::vector<LaunchRecord>* launches = nullptr;  // takes all launches, where there is one
};

}  // namespace splotchcl
