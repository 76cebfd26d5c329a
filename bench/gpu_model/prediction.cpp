#include "gpu_model/prediction.h"

#include <algorithm>

#include "device/opencl/stage_timer.h"

namespace splotchcl::bench {
namespace {

// From one kernel of a queue to the next, where the host does not wait.
constexpr double seconds_of_launch = 3e-6;

}  // namespace

const std::array<DeviceSheet, 5>& device_sheets() {
  static const std::array<DeviceSheet, 5> sheets = {{{"Iris Xe (96 EU)", 68, 2.1, 96},
                                                     {"RTX 4070", 504, 29.1, 46},
                                                     {"A100 SXM 80 GB", 2039, 19.5, 108},
                                                     {"H100 SXM", 3350, 66.9, 132},
                                                     {"MI300X", 5300, 163.4, 304}}};
  return sheets;
}

std::vector<KernelWork> add_up(const std::vector<LaunchRecord>& launches, const FrameWork& work) {
  std::vector<KernelWork> kernels;
  for (const LaunchRecord& launch : launches) {
    auto found = std::find_if(kernels.begin(), kernels.end(), [&](const KernelWork& k) {
      return k.stage == launch.stage && k.kernel == launch.kernel;
    });
    const auto items = static_cast<double>(launch.items);
    if (found == kernels.end()) {
      found = kernels.insert(kernels.end(), KernelWork{});
      found->stage = launch.stage;
      found->kernel = launch.kernel;
      found->least_items = items;
    }
    found->launches += 1;
    found->items += items;
    found->seconds += seconds_of(launch.event);
    found->least_items = std::min(found->least_items, items);
    found->local_bytes = std::max(found->local_bytes, launch.local_bytes);
  }
  for (KernelWork& kernel : kernels)
    kernel.cost = cost_of(kernel.kernel, kernel.items, kernel.launches, work);
  return kernels;
}

double RooflineTime::total() const {
  return std::max({memory, operations, launching});
}

const char* RooflineTime::bound_by() const {
  if (launching >= memory && launching >= operations) return "launches";
  return memory >= operations ? "memory" : "operations";
}

RooflineTime roofline(const KernelWork& work, const DeviceSheet& device) {
  RooflineTime time;
  time.memory =
      (work.cost.bytes_read + work.cost.bytes_written) / (1e9 * device.gigabytes_per_second);
  time.operations = work.cost.operations / (0.5e12 * device.teraflops);
  time.launching = work.launches * seconds_of_launch;
  return time;
}

}  // namespace splotchcl::bench
