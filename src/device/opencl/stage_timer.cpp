#include "device/opencl/stage_timer.h"

#include <algorithm>

namespace splotchcl {

template <class IsCounted>
std::vector<StageTime> StageTimer::sum(IsCounted is_counted) const {
  std::vector<StageTime> times;
  for (const Command& command : commands_) {
    if (!is_counted(command.kind)) continue;
    const std::string stage_name = command.stage;
    auto found = std::find_if(times.begin(), times.end(),
                              [&](const StageTime& t) { return t.stage == stage_name; });
    if (found == times.end()) found = times.insert(times.end(), StageTime{stage_name, 0});
    const auto start = command.event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_START);
    const auto end = command.event.get_profiling_info<cl_ulong>(CL_PROFILING_COMMAND_END);
    found->seconds += 1e-9 * static_cast<double>(end - start);
  }
  return times;
}

std::vector<StageTime> StageTimer::times() const {
  return sum([](Kind kind) { return kind != Kind::copy; });
}

std::vector<StageTime> StageTimer::serial_times() const {
  return sum([](Kind kind) { return kind != Kind::parallel; });
}

std::vector<TimeSpan> StageTimer::spans() const {
  const auto clock_of = [](const Command& command, cl_profiling_info when) {
    return std::chrono::nanoseconds(command.event.get_profiling_info<cl_ulong>(when));
  };
  std::chrono::steady_clock::time_point start_of_clock =
      std::chrono::steady_clock::time_point::max();
  for (const Command& command : commands_)
    start_of_clock =
        std::min(start_of_clock, command.added - clock_of(command, CL_PROFILING_COMMAND_QUEUED));
  std::vector<TimeSpan> spans;
  for (const Command& command : commands_) {
    spans.push_back({command.stage, true,
                     start_of_clock + clock_of(command, CL_PROFILING_COMMAND_START),
                     start_of_clock + clock_of(command, CL_PROFILING_COMMAND_END)});
  }
  return spans;
}

}  // namespace splotchcl
