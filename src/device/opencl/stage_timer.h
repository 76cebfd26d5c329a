#pragma once

#include <string>
#include <utility>
#include <vector>

#include "device/opencl/opencl.h"
#include "splotchcl/renderer.h"

namespace splotchcl {

// Adds up the device's own times of the commands of each stage.
class StageTimer {
 public:
  void add(const char* stage, const compute::event& event) { events_.emplace_back(stage, event); }
  // Call when the queue has finished: stages in the order of their first command.
  std::vector<StageTime> times() const;
  void clear() { events_.clear(); }

 private:
  std::vector<std::pair<const char*, compute::event>> events_;
};

}  // namespace splotchcl
