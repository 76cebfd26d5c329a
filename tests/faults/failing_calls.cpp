// Preloaded into the program (LD_PRELOAD), makes one call of the system fail: SPLOTCHCL_FAULT is
// the call and which of its calls, as in write:3. SPLOTCHCL_FAULT_COUNTS names a file in which all
// are counted. Not counted are
// - writes to standard output and errors,
// - what comes before the program has put up its guard against crashes,
// - what the OpenCL implementation does within its calls and in its threads: PoCL and LLVM end the
//   program where memory runs out, and nobody but they can change that,
// - what libraries do while they are loaded: OpenImageIO brings some along that end the program, or
//   wait for ever, where they find no memory or no thread then,
// - what HDF5 does as it starts: where memory runs out then, it ends the program in a loop,
// - what other programs do that are started. With SPLOTCHCL_FAULT_IN=children it is those of the
//   program itself, which compile kernels for it, that fail, and not the first one.
#include <CL/cl.h>
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "faults/counted_calls.h"

extern "C" char* program_invocation_short_name;

extern "C" void* __libc_malloc(std::size_t bytes);
extern "C" void* __libc_calloc(std::size_t count, std::size_t bytes);
extern "C" void* __libc_realloc(void* memory, std::size_t bytes);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t bytes);

namespace {

using splotchcl::test::CallCounts;
using splotchcl::test::counted_calls;

std::atomic<bool> is_guarded{false};
// Within the OpenCL implementation, or within this file.
thread_local int elsewhere __attribute__((tls_model("initial-exec"))) = 0;

class Elsewhere {
 public:
  Elsewhere() { ++elsewhere; }
  ~Elsewhere() { --elsewhere; }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;
};

// The function that would be called without this file. It is looked for by whichever thread asks
// first, without a lock: one that loads a library keeps all others from looking, and would itself
// wait for one that keeps a lock and looks.
template <typename Function>
class Original {
 public:
  constexpr Original(Function*, const char* name) : name_(name) {}
  operator Function*() {
    Function* known = known_;
    if (known == nullptr) {
      const Elsewhere here;  // it may allocate
      known = reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name_));
      known_ = known;
    }
    return known;
  }

 private:
  const char* name_;
  std::atomic<Function*> known_{nullptr};
};

struct Fault {
  int call = -1;  // of counted_calls
  long which = 0;
};

Fault read_fault() {
  const char* const text = std::getenv("SPLOTCHCL_FAULT");
  const char* const colon = text == nullptr ? nullptr : std::strchr(text, ':');
  if (colon == nullptr) return {};
  for (std::size_t call = 0; call < counted_calls.size(); ++call) {
    const std::size_t length = std::strlen(counted_calls[call]);
    if (static_cast<std::size_t>(colon - text) == length &&
        std::strncmp(text, counted_calls[call], length) == 0) {
      return {static_cast<int>(call), std::atol(colon + 1)};
    }
  }
  std::abort();
}

bool is_meant() {
  const auto is_called = [](const char* name) {
    return std::strcmp(program_invocation_short_name, name) == 0;
  };
  if (!is_called("splotchcl") && !is_called("exe")) return false;  // of /proc/self/exe
  constexpr const char* mark = "SPLOTCHCL_FAULT_PARENT";
  const bool is_child = std::getenv(mark) != nullptr;
  ::setenv(mark, "1", 1);
  const char* const wanted = std::getenv("SPLOTCHCL_FAULT_IN");
  return is_child == (wanted != nullptr && std::strcmp(wanted, "children") == 0);
}

CallCounts* shared_counts() {
  const char* const path = std::getenv("SPLOTCHCL_FAULT_COUNTS");
  static CallCounts own;
  if (path == nullptr) return &own;
  static Original original(&open, "open");
  const int file = original(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0 || ::ftruncate64(file, sizeof(CallCounts)) != 0) std::abort();
  static Original map(&mmap, "mmap");
  void* const memory =
      map(nullptr, sizeof(CallCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) std::abort();
  return static_cast<CallCounts*>(memory);
}

struct Plan {
  bool is_meant = ::is_meant();
  Fault fault = read_fault();
  CallCounts* counts = is_meant ? shared_counts() : nullptr;
};

bool fails(const char* name) {
  if (!is_guarded || elsewhere > 0) return false;
  const Elsewhere here;
  static const Plan plan;
  if (!plan.is_meant) return false;
  int call = 0;
  while (std::strcmp(counted_calls[static_cast<std::size_t>(call)], name) != 0)
    ++call;
  const long count = ++(*plan.counts)[static_cast<std::size_t>(call)];
  return plan.fault.call == call && count == plan.fault.which;
}

template <typename Result>
Result failure(int error, Result result) {
  errno = error;
  return result;
}

mode_t mode_in(int flags, std::va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" int sigaction(int signal, const struct sigaction* action,
                         struct sigaction* before) noexcept {
  static Original original(&sigaction, "sigaction");
  const int result = original(signal, action, before);
  if (signal == SIGILL) is_guarded = true;
  return result;
}

// A call that fails as a whole: what it counts as, its error, and what it returns then.
#define FAILING(counted, error, result, type, name, parameters, arguments, specifier) \
  extern "C" type name parameters specifier {                                         \
    static Original original(&name, #name);                                           \
    return fails(counted) ? failure<type>(error, result) : original arguments;        \
  }                                                                                   \
  static_assert(true)

// All that takes a descriptor counts as "open".

extern "C" int open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  static Original original(&open, "open");
  return fails("open") ? failure(EMFILE, -1) : original(path, flags, mode);
}

extern "C" int open64(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  static Original original(&open64, "open64");
  return fails("open") ? failure(EMFILE, -1) : original(path, flags, mode);
}

FAILING("open", EMFILE, nullptr, std::FILE*, fopen, (const char* path, const char* mode),
        (path, mode), );
FAILING("open", EMFILE, nullptr, std::FILE*, fopen64, (const char* path, const char* mode),
        (path, mode), );
FAILING("open", EMFILE, nullptr, DIR*, opendir, (const char* path), (path), );
FAILING("open", EMFILE, -1, int, mkostemp, (char* name, int flags), (name, flags), );
FAILING("open", EMFILE, -1, int, pipe2, (int* ends, int flags), (ends, flags), noexcept);
FAILING("open", EMFILE, -1, int, dup, (int descriptor), (descriptor), noexcept);
FAILING("open", EMFILE, -1, int, socket, (int domain, int type, int protocol),
        (domain, type, protocol), noexcept);
FAILING("open", EMFILE, -1, int, accept,
        (int descriptor, struct sockaddr* address, socklen_t* length),
        (descriptor, address, length), );
FAILING("read", EIO, -1, ssize_t, read, (int descriptor, void* data, std::size_t bytes),
        (descriptor, data, bytes), );
FAILING("read", EIO, -1, ssize_t, pread,
        (int descriptor, void* data, std::size_t bytes, off_t where),
        (descriptor, data, bytes, where), );
FAILING("read", EIO, -1, ssize_t, pread64,
        (int descriptor, void* data, std::size_t bytes, off64_t where),
        (descriptor, data, bytes, where), );
FAILING("read", ECONNRESET, -1, ssize_t, recvmsg,
        (int descriptor, struct msghdr* message, int flags), (descriptor, message, flags), );

namespace {

// What has no type of a file, such as the counter by which a thread wakes another, takes all bytes
// or none, and none only where it overflows. Pipes take up to so many at once, or none.
bool may_fail(int descriptor) {
  struct stat status {};
  return descriptor > STDERR_FILENO && ::fstat(descriptor, &status) == 0 &&
         (status.st_mode & S_IFMT) != 0;
}
bool may_be_short(int descriptor, std::size_t bytes) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && !(S_ISFIFO(status.st_mode) && bytes <= PIPE_BUF);
}

}  // namespace

extern "C" ssize_t write(int descriptor, const void* data, std::size_t bytes) {
  static Original original(&write, "write");
  if (may_fail(descriptor)) {
    if (fails("write")) return failure<ssize_t>(ENOSPC, -1);
    if (may_be_short(descriptor, bytes) && fails("short_write")) bytes = (bytes + 1) / 2;
  }
  return original(descriptor, data, bytes);
}

extern "C" ssize_t pwrite(int descriptor, const void* data, std::size_t bytes, off_t where) {
  static Original original(&pwrite, "pwrite");
  if (fails("write")) return failure<ssize_t>(ENOSPC, -1);
  if (fails("short_write")) bytes = (bytes + 1) / 2;
  return original(descriptor, data, bytes, where);
}

extern "C" ssize_t pwrite64(int descriptor, const void* data, std::size_t bytes, off64_t where) {
  static Original original(&pwrite64, "pwrite64");
  if (fails("write")) return failure<ssize_t>(ENOSPC, -1);
  if (fails("short_write")) bytes = (bytes + 1) / 2;
  return original(descriptor, data, bytes, where);
}

extern "C" ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  static Original original(&writev, "writev");
  if (descriptor > STDERR_FILENO) {
    if (fails("write")) return failure<ssize_t>(ENOSPC, -1);
    if (fails("short_write") && count > 1) count = 1;
  }
  return original(descriptor, parts, count);
}

FAILING("write", ECONNRESET, -1, ssize_t, sendmsg,
        (int descriptor, const struct msghdr* message, int flags), (descriptor, message, flags), );
FAILING("fsync", EIO, -1, int, fsync, (int descriptor), (descriptor), );

// The descriptor is closed in any case, as Linux does it.
extern "C" int close(int descriptor) {
  static Original original(&close, "close");
  const bool is_failure = fails("close");
  const int result = original(descriptor);
  return is_failure ? failure(EIO, -1) : result;
}

extern "C" int fclose(std::FILE* file) {
  static Original original(&fclose, "fclose");
  const bool is_failure = fails("close");
  const int result = original(file);
  return is_failure ? failure(EIO, EOF) : result;
}

FAILING("rename", EACCES, -1, int, rename, (const char* from, const char* to), (from, to),
        noexcept);
FAILING("link", EPERM, -1, int, link, (const char* from, const char* to), (from, to), noexcept);
FAILING("unlink", EACCES, -1, int, unlink, (const char* path), (path), noexcept);
FAILING("unlink", EACCES, -1, int, remove, (const char* path), (path), noexcept);
FAILING("truncate", EIO, -1, int, ftruncate, (int descriptor, off_t bytes), (descriptor, bytes),
        noexcept);
FAILING("truncate", EIO, -1, int, ftruncate64, (int descriptor, off64_t bytes), (descriptor, bytes),
        noexcept);
FAILING("mkdir", ENOSPC, -1, int, mkdir, (const char* path, mode_t mode), (path, mode), noexcept);
FAILING("mmap", ENOMEM, MAP_FAILED, void*, mmap,
        (void* place, std::size_t bytes, int protection, int flags, int descriptor, off_t where),
        (place, bytes, protection, flags, descriptor, where), noexcept);
FAILING("fork", EAGAIN, -1, pid_t, fork, (), (), noexcept);

extern "C" int posix_spawn(pid_t* child, const char* path,
                           const posix_spawn_file_actions_t* actions,
                           const posix_spawnattr_t* attributes, char* const* arguments,
                           char* const* environment) {
  static Original original(&posix_spawn, "posix_spawn");
  return fails("fork") ? EAGAIN
                       : original(child, path, actions, attributes, arguments, environment);
}

namespace {

struct ThreadOfOpenCl {
  void* (*start)(void*);
  void* argument;
};

void* run_elsewhere(void* argument) {
  ++elsewhere;
  const ThreadOfOpenCl thread = *static_cast<ThreadOfOpenCl*>(argument);
  delete static_cast<ThreadOfOpenCl*>(argument);
  return thread.start(thread.argument);
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
  static Original original(&pthread_create, "pthread_create");
  if (fails("thread")) return EAGAIN;
  if (elsewhere == 0) return original(thread, attributes, start, argument);
  return original(thread, attributes, &run_elsewhere, new ThreadOfOpenCl{start, argument});
}

extern "C" int H5open() {
  static Original original(&H5open, "H5open");
  const Elsewhere here;
  return original();
}

extern "C" void* dlopen(const char* path, int mode) noexcept {
  static Original original(&dlopen, "dlopen");
  const Elsewhere here;
  return original(path, mode);
}

extern "C" void* malloc(std::size_t bytes) noexcept {
  return fails("malloc") ? failure<void*>(ENOMEM, nullptr) : __libc_malloc(bytes);
}

extern "C" void* calloc(std::size_t count, std::size_t bytes) noexcept {
  return fails("malloc") ? failure<void*>(ENOMEM, nullptr) : __libc_calloc(count, bytes);
}

extern "C" void* realloc(void* memory, std::size_t bytes) noexcept {
  return fails("malloc") ? failure<void*>(ENOMEM, nullptr) : __libc_realloc(memory, bytes);
}

extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
  return fails("malloc") ? failure<void*>(ENOMEM, nullptr) : __libc_memalign(alignment, bytes);
}

// The functions of OpenCL that the program calls: what happens within is not counted. Each is
// found when the library is loaded, and has the type that its header declares.
namespace {

template <typename Function>
struct Within;

template <typename Result, typename... Arguments>
struct Within<Result(Arguments...)> {
  template <const char* name>
  static Result call(Arguments... arguments) {
    using Function = Result(Arguments...);
    static Original<Function> original(nullptr, name);
    const Elsewhere here;
    return original(arguments...);
  }
};

}  // namespace

#define WITHIN(function)                                                 \
  namespace {                                                            \
  constexpr char name_of_##function[] = #function;                       \
  }                                                                      \
  extern "C" {                                                           \
  __attribute__((used)) static decltype(&(function)) find_##function() { \
    return &Within<decltype(function)>::call<name_of_##function>;        \
  }                                                                      \
  __attribute__((ifunc("find_" #function))) decltype(function) function; \
  }                                                                      \
  static_assert(true)

WITHIN(clBuildProgram);
WITHIN(clCreateBuffer);
WITHIN(clCreateCommandQueue);
WITHIN(clCreateContext);
WITHIN(clCreateKernel);
WITHIN(clCreateProgramWithBinary);
WITHIN(clCreateProgramWithSource);
WITHIN(clCreateSubBuffer);
WITHIN(clEnqueueCopyBuffer);
WITHIN(clEnqueueFillBuffer);
WITHIN(clEnqueueMapBuffer);
WITHIN(clEnqueueNDRangeKernel);
WITHIN(clEnqueueReadBuffer);
WITHIN(clEnqueueUnmapMemObject);
WITHIN(clEnqueueWriteBuffer);
WITHIN(clFinish);
WITHIN(clFlush);
WITHIN(clGetContextInfo);
WITHIN(clGetDeviceIDs);
WITHIN(clGetDeviceInfo);
WITHIN(clGetEventProfilingInfo);
WITHIN(clGetExtensionFunctionAddress);
WITHIN(clGetKernelInfo);
WITHIN(clGetKernelWorkGroupInfo);
WITHIN(clGetMemObjectInfo);
WITHIN(clGetPlatformIDs);
WITHIN(clGetPlatformInfo);
WITHIN(clGetProgramBuildInfo);
WITHIN(clGetProgramInfo);
WITHIN(clReleaseCommandQueue);
WITHIN(clReleaseContext);
WITHIN(clReleaseDevice);
WITHIN(clReleaseEvent);
WITHIN(clReleaseKernel);
WITHIN(clReleaseMemObject);
WITHIN(clReleaseProgram);
WITHIN(clRetainCommandQueue);
WITHIN(clRetainContext);
WITHIN(clRetainDevice);
WITHIN(clRetainEvent);
WITHIN(clRetainKernel);
WITHIN(clRetainMemObject);
WITHIN(clSetKernelArg);
WITHIN(clSetMemObjectDestructorCallback);
WITHIN(clWaitForEvents);
