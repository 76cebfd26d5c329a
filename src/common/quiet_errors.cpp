#include "common/quiet_errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

namespace splotchcl {
namespace {

std::mutex mutex;
int depth = 0;
std::atomic<bool> is_wanted{false};
std::atomic<int> kept{-1};  // standard error while it leads nowhere

}  // namespace

QuietErrors::QuietErrors() {
  const std::lock_guard lock(mutex);
  if (!is_wanted || depth++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  kept = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietErrors::~QuietErrors() {
  const std::lock_guard lock(mutex);
  if (!is_wanted || --depth > 0 || kept < 0) return;
  const int original = kept.exchange(-1);
  ::dup2(original, STDERR_FILENO);
  ::close(original);
}

void let_errors_be_quiet() {
  is_wanted = true;
}

int error_descriptor() {
  const int original = kept;
  return original >= 0 ? original : STDERR_FILENO;
}

}  // namespace splotchcl
