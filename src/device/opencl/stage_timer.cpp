#include "device/opencl/stage_timer.h"

#include <algorithm>

namespace splotchcl {

std::vector<StageTime> StageTimer::times() const {
  std::vector<StageTime> times;
  for (const auto& [stage, event] : events_) {
    const auto start = event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_START);
    const auto end = event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_END);
    const std::string stage_name = stage;
    auto found = std::find_if(times.begin(), times.end(),
                              [&](const StageTime& t) { return t.stage == stage_name; });
    if (found == times.end()) found = times.insert(times.end(), StageTime{stage_name, 0});
    found->seconds += 1e-9 * static_cast<double>(end - start);
  }
  return times;
}

}  // namespace splotchcl
