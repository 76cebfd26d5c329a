// Preloaded into the program (LD_PRELOAD), makes one call of the system fail: SPLOTCHCL_FAULT is
// the call and which of its calls, as in write:3. Writes to standard output and errors do not
// count, nor does what other programs do that are started, nor what comes before the program has
// put up its guard against crashes.
#include <dlfcn.h>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

extern "C" char* program_invocation_short_name;

namespace {

std::atomic<long> calls{0};
std::atomic<bool> is_guarded{false};

// Which call of this name fails; 0: none.
long failing(const char* name) {
  static const char* const fault = std::getenv("SPLOTCHCL_FAULT");
  if (fault == nullptr || program_invocation_short_name == nullptr) return 0;
  const std::size_t length = std::strlen(name);
  if (std::strncmp(fault, name, length) != 0 || fault[length] != ':') return 0;
  if (std::strcmp(program_invocation_short_name, "splotchcl") != 0) return 0;
  return std::atol(fault + length + 1);
}

bool fails(const char* name) {
  if (!is_guarded) return false;
  const long which = failing(name);
  return which > 0 && ++calls == which;
}

template <typename Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int sigaction(int signal, const struct sigaction* action,
                         struct sigaction* before) noexcept {
  static auto* const original = next(&sigaction, "sigaction");
  const int result = original(signal, action, before);
  if (signal == SIGILL) is_guarded = true;
  return result;
}

extern "C" ssize_t write(int descriptor, const void* data, std::size_t bytes) {
  static auto* const original = next(&write, "write");
  if (descriptor > 2 && fails("write")) {
    errno = ENOSPC;
    return -1;
  }
  return original(descriptor, data, bytes);
}

extern "C" int fsync(int descriptor) {
  static auto* const original = next(&fsync, "fsync");
  if (fails("fsync")) {
    errno = EIO;
    return -1;
  }
  return original(descriptor);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static auto* const original = next(&rename, "rename");
  if (fails("rename")) {
    errno = EACCES;
    return -1;
  }
  return original(from, to);
}

extern "C" void* __libc_malloc(std::size_t bytes);

extern "C" void* malloc(std::size_t bytes) {
  if (fails("malloc")) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(bytes);
}
