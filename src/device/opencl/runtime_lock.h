#pragma once

#include <mutex>

namespace splotchcl {

// Held while platforms are opened, devices and contexts made and programs built: OpenCL
// implementations should allow several threads there, but loaders and compilers do not all. A
// process has one OpenCL runtime, hence one lock. Throws DeviceError in a process that was forked
// after OpenCL had been used.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock_runtime();

// Throws DeviceError there, too.
void require_runtime();

// Whether this process was forked after OpenCL had been used. OpenCL's threads do not live on in
// it, and its locks may be held by threads that are not there: every call may wait without end.
bool is_forked_from_runtime();

}  // namespace splotchcl
