#include "device/opencl/runtime_lock.h"

#include <atomic>

#include "splotchcl/error.h"

#if defined(__unix__) || defined(__APPLE__)
#define SPLOTCHCL_HAS_POSIX_FILES
#include <unistd.h>
#endif

namespace splotchcl {
namespace {

#ifdef SPLOTCHCL_HAS_POSIX_FILES
// The first one that used OpenCL; 0: none yet.
std::atomic<::pid_t>& process_of_runtime() {
  static std::atomic<::pid_t> process{0};
  return process;
}
#endif

}  // namespace

bool is_forked_from_runtime() {
#ifdef SPLOTCHCL_HAS_POSIX_FILES
  const ::pid_t process = process_of_runtime();
  return process != 0 && process != ::getpid();
#else
  return false;
#endif
}

void require_runtime() {
#ifdef SPLOTCHCL_HAS_POSIX_FILES
  ::pid_t nobody = 0;
  process_of_runtime().compare_exchange_strong(nobody, ::getpid());
#endif
  if (!is_forked_from_runtime()) return;
  throw DeviceError(
      "OpenCL was used before this process was forked, and does not work in it; start processes "
      "anew (multiprocessing's spawn), or fork before anything is drawn");
}

RuntimeLock lock_runtime() {
  static std::recursive_mutex mutex;
  require_runtime();
  return RuntimeLock(mutex);
}

}  // namespace splotchcl
