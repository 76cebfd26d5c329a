#pragma once

#include <mutex>

namespace splotchcl {

// Held while platforms are opened, devices and contexts made and programs built: OpenCL
// implementations should allow several threads there, but loaders and compilers do not all. A
// process has one OpenCL runtime, hence one lock.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock_runtime();

}  // namespace splotchcl
