#pragma once

#include <string>

#include "splotchcl/renderer.h"

namespace splotchcl::bench {

// Where numbers were measured; every result says so.
struct Machine {
  std::string processor;
  DeviceInfo device;
  int vector_floats = 0;  // of the vectors that kernels are compiled for
  double load = 0;        // processes that wanted to run, mean of the last minute
  int threads() const { return device.compute_units; }
};

// The device whose name holds this, or the one that a Renderer would use. Throws
// DeviceError.
Machine describe_machine(const std::string& part_of_device_name = "");
std::string describe(const Machine& machine);

}  // namespace splotchcl::bench
