#pragma once

#include <memory>

#include "device/opencl/opencl.h"

namespace splotchcl {

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

}  // namespace splotchcl
