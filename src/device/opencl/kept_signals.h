#pragma once

#include <array>

#if defined(__unix__) || defined(__APPLE__)
#include <signal.h>
#define SPLOTCHCL_HAS_SIGNALS
#endif

namespace splotchcl {

// Puts signals back to what the process does with them, at its end: compilers of kernels take them
// for themselves, and what ends the process then neither tells why nor removes what it has begun.
// Signals by which others end the process only where it had handled them: in another thread it may
// have begun to meanwhile.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
#ifdef SPLOTCHCL_HAS_SIGNALS
  static constexpr std::array<int, 9> of_faults = {SIGABRT, SIGBUS,  SIGFPE,  SIGILL, SIGSEGV,
                                                   SIGSYS,  SIGTRAP, SIGXCPU, SIGXFSZ};
  static constexpr std::array<int, 6> of_others = {SIGHUP,  SIGINT,  SIGQUIT,
                                                   SIGTERM, SIGUSR1, SIGUSR2};
  std::array<struct sigaction, of_faults.size()> at_faults_ = {};
  std::array<struct sigaction, of_others.size()> at_others_ = {};
#endif
};

}  // namespace splotchcl
