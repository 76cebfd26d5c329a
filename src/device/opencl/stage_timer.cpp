#include "device/opencl/stage_timer.h"

#include <algorithm>

namespace splotchcl {

double seconds_of(const compute::event& event) {
  const auto start = event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_START);
  const auto end = event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_END);
  return 1e-9 * static_cast<double>(end - start);
}

template <class IsCounted>
std::vector<StageTime> StageTimer::sum(IsCounted is_counted) const {
  std::vector<StageTime> times;
  for (const Command& command : commands_) {
    if (!is_counted(command.kind)) continue;
    const std::string stage_name = command.stage;
    auto found = std::find_if(times.begin(), times.end(),
                              [&](const StageTime& t) { return t.stage == stage_name; });
    if (found == times.end()) found = times.insert(times.end(), StageTime{stage_name, 0});
    found->seconds += seconds_of(command.event);
  }
  return times;
}

std::vector<StageTime> StageTimer::times() const {
  return sum([](Kind kind) { return kind != Kind::copy; });
}

std::vector<StageTime> StageTimer::serial_times() const {
  return sum([](Kind kind) { return kind != Kind::parallel; });
}

}  // namespace splotchcl
