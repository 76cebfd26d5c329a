#include "device/opencl/runtime_lock.h"

namespace splotchcl {

std::unique_lock<std::recursive_mutex> lock_runtime() {
  static std::recursive_mutex mutex;
  return std::unique_lock<std::recursive_mutex>(mutex);
}

}  // namespace splotchcl
