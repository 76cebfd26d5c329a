#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure.h"

namespace splotchcl::bench {

struct ProcessCost {
  Cost cost;
  std::uint64_t largest_resident_bytes = 0;  // mapped files included
};

// Runs a program from start to end, its standard output thrown away. Throws DataError when
// it cannot be started or fails.
ProcessCost run_process(const std::vector<std::string>& words);

// Memory of this process that no file backs: heap, stacks, and the buffers of an OpenCL
// device that is the processor itself.
std::uint64_t anonymous_bytes();

}  // namespace splotchcl::bench
