#include "device/opencl/kept_signals.h"

#include <cstddef>

namespace splotchcl {

#ifdef SPLOTCHCL_HAS_SIGNALS

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

void put_back(int signal, const struct sigaction& before) {
  struct sigaction now = {};
  if (::sigaction(signal, nullptr, &now) == 0 && !are_same(now, before)) {
    ::sigaction(signal, &before, nullptr);
  }
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
    if (is_handled(at_others_[i])) put_back(of_others[i], at_others_[i]);
  }
}

#else

KeptSignals::KeptSignals() = default;
KeptSignals::~KeptSignals() = default;

#endif

}  // namespace splotchcl
