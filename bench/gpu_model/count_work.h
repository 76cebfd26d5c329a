#pragma once

#include <cstdint>
#include <vector>

#include "device/opencl/device_context.h"
#include "device/opencl/launch_record.h"
#include "gpu_model/kernel_costs.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl::bench {

// How the device was used, and for what.
struct CountedWork {
  FrameWork work;
  std::vector<LaunchRecord> launches;
};

// Draws the frame once with the kernels and the sizes for GPUs, on any device. Tiles that stop
// early are counted in full.
CountedWork count_frame(DeviceContext& device, const Frame& frame, const PlanOptions& options = {});

// Sorts so many pairs with random keys.
CountedWork count_sort(DeviceContext& device, std::uint32_t pairs);

}  // namespace splotchcl::bench
