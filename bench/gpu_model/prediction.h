#pragma once

#include <array>
#include <string>
#include <vector>

#include "device/opencl/launch_record.h"
#include "gpu_model/kernel_costs.h"

namespace splotchcl::bench {

// A device as its vendor describes it. Nothing here was measured.
struct DeviceSheet {
  const char* name;
  double gigabytes_per_second;  // of its memory
  double teraflops;             // single precision, a multiplication with an addition being two
  int units;                    // compute units, or what the vendor calls so
};
const std::array<DeviceSheet, 5>& device_sheets();

// All launches of one kernel of a frame.
struct KernelWork {
  std::string stage, kernel;
  double launches = 0, items = 0;
  double least_items = 0;  // in flight in the smallest of its launches
  double seconds = 0;      // that they took on the device at hand
  std::uint64_t local_bytes = 0;
  KernelCost cost;
};
// Call when the queue has finished.
std::vector<KernelWork> add_up(const std::vector<LaunchRecord>& launches, const FrameWork& work);

// What a kernel takes on a device at least: the longer of what its bytes and its operations take at
// the rates of the sheet, and what launching takes.
struct RooflineTime {
  double memory = 0, operations = 0, launching = 0;  // seconds
  double total() const;
  const char* bound_by() const;
};
RooflineTime roofline(const KernelWork& work, const DeviceSheet& device);

}  // namespace splotchcl::bench
