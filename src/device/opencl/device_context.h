#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/opencl/buffer_pool.h"
#include "device/opencl/device_traits.h"
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

// Where commands of a device run: in order, and their times are noted.
struct DeviceQueue {
  explicit DeviceQueue(const compute::device& device);

  compute::context context;
  compute::command_queue queue;
};

// A queue of the caller's own; on PoCL's processors, one that the process shares for as long as
// somebody has it. PoCL 3.1 aborts where several queues run one kernel at the same time for
// different numbers of work-groups: it keeps a copy of the kernel for the largest number so far,
// and at the end of a run lets go of the newest copy, whichever one ran
// (pocl_release_dlhandle_cache). Commands of several queues share the processor's threads in any
// case.
std::shared_ptr<DeviceQueue> open_queue(const compute::device& device);

// What may be in use at one time, in bytes.
struct DeviceMemory {
  std::uint64_t total = 0;    // of working memory: planes, splats, keys, lists
  std::uint64_t columns = 0;  // of particles' columns, on a device with memory of its own
};

// What a device has room for beside all else that uses its memory.
DeviceMemory memory_of(const compute::device& device, const DeviceTraits& traits);

// One launch of a kernel, for tests and models that ask how the device was used.
struct LaunchRecord {
  std::string stage, kernel;
  std::size_t items = 0, group_items = 0;  // work-items in all, and in a work-group
  std::uint64_t local_bytes = 0;           // local memory of a group
  compute::event event;                    // says when it ran, once the queue has finished
};

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

// The largest error of the device's own 2^t, relative to 2^t, among 65537 places from -126 to 0,
// half of them above -1; infinite where it is no number, or not tiny below -126. The language
// promises nothing of it.
double error_of_native_exp2(DeviceContext& device);

// Whether it is as exact as the polynomial in whose place it is taken (gaussian.cl).
bool native_exp2_serves(DeviceContext& device);

}  // namespace splotchcl
