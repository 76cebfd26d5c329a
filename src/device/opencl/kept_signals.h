#pragma once

#include <array>

#if defined(__unix__) || defined(__APPLE__)
#include <signal.h>
#define SPLOTCHCL_HAS_SIGNALS
#endif

namespace splotchcl {

// Puts signals back to what the process does with them, at its end: compilers of kernels take them
// for themselves, and what ends the process then neither tells why nor removes what it has begun.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
#ifdef SPLOTCHCL_HAS_SIGNALS
  static constexpr int last_signal = 31;  // of those that have names
  std::array<struct sigaction, last_signal + 1> before_ = {};
#endif
};

}  // namespace splotchcl
