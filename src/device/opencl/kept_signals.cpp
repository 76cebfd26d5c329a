#include "device/opencl/kept_signals.h"

namespace splotchcl {

#ifdef SPLOTCHCL_HAS_SIGNALS

namespace {

bool are_same(const struct sigaction& a, const struct sigaction& b) {
  if ((a.sa_flags & SA_SIGINFO) != (b.sa_flags & SA_SIGINFO)) return false;
  return (a.sa_flags & SA_SIGINFO) != 0 ? a.sa_sigaction == b.sa_sigaction
                                        : a.sa_handler == b.sa_handler;
}

}  // namespace

KeptSignals::KeptSignals() {
  for (int signal = 1; signal <= last_signal; ++signal)
    ::sigaction(signal, nullptr, &before_[static_cast<std::size_t>(signal)]);
}

KeptSignals::~KeptSignals() {
  for (int signal = 1; signal <= last_signal; ++signal) {
    const struct sigaction& before = before_[static_cast<std::size_t>(signal)];
    struct sigaction now = {};
    if (::sigaction(signal, nullptr, &now) == 0 && !are_same(now, before)) {
      ::sigaction(signal, &before, nullptr);
    }
  }
}

#else

KeptSignals::KeptSignals() = default;
KeptSignals::~KeptSignals() = default;

#endif

}  // namespace splotchcl
