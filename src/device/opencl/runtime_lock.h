#pragma once

#include <mutex>

#include "device/opencl/kept_signals.h"

namespace splotchcl {

// While it lives, no other thread has one, and at its end signals are what they were.
class RuntimeLock {
 public:
  explicit RuntimeLock(std::recursive_mutex& mutex) : lock_(mutex) {}

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  KeptSignals signals_;
};

// Held while platforms are opened, devices and contexts made and programs built: OpenCL
// implementations should allow several threads there, but loaders and compilers do not all. A
// process has one OpenCL runtime, hence one lock. Throws DeviceError in a process that was forked
// after OpenCL had been used.
[[nodiscard]] RuntimeLock lock_runtime();

// Throws DeviceError there, too.
void require_runtime();

// Whether this process was forked after OpenCL had been used. OpenCL's threads do not live on in
// it, and its locks may be held by threads that are not there: every call may wait without end.
bool is_forked_from_runtime();

}  // namespace splotchcl
