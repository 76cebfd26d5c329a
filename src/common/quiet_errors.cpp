#include "common/quiet_errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace splotchcl {
namespace {

std::mutex mutex;
int depth = 0;
// Standard error as the program was given it: set once, before there are other threads.
int kept = -1;
std::FILE* kept_stream = nullptr;

}  // namespace

QuietErrors::QuietErrors() {
  const std::lock_guard lock(mutex);
  if (kept < 0 || depth++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietErrors::~QuietErrors() {
  const std::lock_guard lock(mutex);
  if (kept < 0 || --depth > 0) return;
  ::dup2(kept, STDERR_FILENO);
}

void let_errors_be_quiet() {
  if (kept >= 0) return;
  kept = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept < 0) return;
  kept_stream = ::fdopen(kept, "w");
  if (kept_stream != nullptr) std::setvbuf(kept_stream, nullptr, _IONBF, 0);
}

int error_descriptor() {
  return kept >= 0 ? kept : STDERR_FILENO;
}

std::FILE* error_stream() {
  return kept_stream != nullptr ? kept_stream : stderr;
}

}  // namespace splotchcl
