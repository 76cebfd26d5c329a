#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "device/opencl/opencl.h"

namespace splotchcl {

// One launch of a kernel, for tests and models that ask how the device was used.
struct LaunchRecord {
  std::string stage, kernel;
  std::size_t items = 0, group_items = 0;  // work-items in all, and in a work-group
  std::uint64_t local_bytes = 0;           // local memory of a group
  compute::event event;                    // says when it ran, once the queue has finished
};

}  // namespace splotchcl
