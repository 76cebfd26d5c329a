#pragma once

#include <signal.h>

#include <array>
#include <mutex>

namespace splotchcl {

// Puts signals back to what the process does with them, at its end: compilers of kernels take them
// for themselves, and what ends the process then neither tells why nor removes what it has begun.
// Not where this library or the program itself has taken them meanwhile, in another thread: what
// was there before may be a compiler's. Signals by which others end the process only where they
// were handled, and are: the first one may have come.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array<int, 9> of_faults = {SIGABRT, SIGBUS,  SIGFPE,  SIGILL, SIGSEGV,
                                                   SIGSYS,  SIGTRAP, SIGXCPU, SIGXFSZ};
  static constexpr std::array<int, 6> of_others = {SIGHUP,  SIGINT,  SIGQUIT,
                                                   SIGTERM, SIGUSR1, SIGUSR2};
  std::array<struct sigaction, of_faults.size()> at_faults_ = {};
  std::array<struct sigaction, of_others.size()> at_others_ = {};
};

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
