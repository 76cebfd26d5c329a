#include "device/opencl/runtime_lock.h"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The first one that used OpenCL; 0: none yet.
std::atomic<::pid_t>& process_of_runtime() {
  static std::atomic<::pid_t> process{0};
  return process;
}

}  // namespace

bool is_forked_from_runtime() {
  const ::pid_t process = process_of_runtime();
  return process != 0 && process != ::getpid();
}

void require_runtime() {
  ::pid_t nobody = 0;
  process_of_runtime().compare_exchange_strong(nobody, ::getpid());
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

namespace {

bool are_same(const struct sigaction& a, const struct sigaction& b) {
  if ((a.sa_flags & SA_SIGINFO) != (b.sa_flags & SA_SIGINFO)) return false;
  return (a.sa_flags & SA_SIGINFO) != 0 ? a.sa_sigaction == b.sa_sigaction
                                        : a.sa_handler == b.sa_handler;
}

bool is_handled(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 ||
         (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

const void* code_of(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 ? reinterpret_cast<const void*>(action.sa_sigaction)
                                             : reinterpret_cast<const void*>(action.sa_handler);
}

// The library that holds it, or the program; null: none.
const void* object_of(const void* code) {
  Dl_info info = {};
  return ::dladdr(code, &info) != 0 ? info.dli_fbase : nullptr;
}

// Whether it was asked for by this library, or by who had asked before: in another thread,
// meanwhile.
bool is_own(const struct sigaction& now, const struct sigaction& before) {
  if (!is_handled(now)) return false;
  const void* const object = object_of(code_of(now));
  return object == object_of(reinterpret_cast<const void*>(&lock_runtime)) ||
         object == object_of(code_of(before));
}

struct sigaction action_at(int signal) {
  struct sigaction now = {};
  ::sigaction(signal, nullptr, &now);
  return now;
}

void put_back(int signal, const struct sigaction& before) {
  const struct sigaction now = action_at(signal);
  if (!are_same(now, before) && !is_own(now, before)) ::sigaction(signal, &before, nullptr);
}

}  // namespace

KeptSignals::KeptSignals() {
  for (std::size_t i = 0; i < of_faults.size(); ++i)
    ::sigaction(of_faults[i], nullptr, &at_faults_[i]);
  for (std::size_t i = 0; i < of_others.size(); ++i)
    ::sigaction(of_others[i], nullptr, &at_others_[i]);
}

KeptSignals::~KeptSignals() {
  for (std::size_t i = 0; i < of_faults.size(); ++i)
    put_back(of_faults[i], at_faults_[i]);
  for (std::size_t i = 0; i < of_others.size(); ++i) {
    if (is_handled(at_others_[i]) && is_handled(action_at(of_others[i])))
      put_back(of_others[i], at_others_[i]);
  }
}

}  // namespace splotchcl
