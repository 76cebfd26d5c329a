#pragma once

#include <cstddef>

#include "device/opencl/opencl.h"

namespace splotchcl {

// Makes a processor's buffers in memory that the system is asked to put on pages of 2 MiB, where it
// has such: they are made with a five-hundredth of the interruptions of small ones, and splats that
// lie all over hundreds of megabytes are found without a walk through tables of pages for each.
// What is too small for that, and what the system refuses, lies on small pages. For devices that
// use the host's memory at any address (DeviceTraits::large_pages).
class LargePages {
 public:
  // Throws compute::opencl_error where there is no such memory.
  compute::buffer buffer(const compute::context& context, std::size_t bytes);

 private:
  std::size_t made_ = 0;
};

}  // namespace splotchcl
