#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "device/opencl/opencl.h"
#include "splotchcl/renderer.h"

namespace splotchcl {

class StageTimer {
 public:
  // What several cores may share, or not: on a processor a fill or a copy is one thread's work.
  enum class Kind { parallel, serial, copy };

  void add(const char* stage, const compute::event& event, Kind kind) {
    commands_.push_back({stage, event, kind, std::chrono::steady_clock::now()});
  }
  // Between the host's memory and the device's: of no stage.
  void add_copy(const compute::event& event) { add("copies", event, Kind::copy); }
  // Call when the queue has finished: stages in the order of their first command.
  std::vector<StageTime> times() const;
  // Of commands that one thread runs, likewise.
  std::vector<StageTime> serial_times() const;
  // When each command ran, by the host's clock. The device's is set by the command that took least
  // time from there to add().
  std::vector<TimeSpan> spans() const;
  void clear() { commands_.clear(); }

 private:
  struct Command {
    const char* stage;
    compute::event event;
    Kind kind;
    std::chrono::steady_clock::time_point added;
  };
  template <class IsCounted>
  std::vector<StageTime> sum(IsCounted is_counted) const;

  std::vector<Command> commands_;
};

}  // namespace splotchcl
