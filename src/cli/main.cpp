#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/processes.h"
#include "common/guards.h"
#include "device/opencl/pocl_cache.h"
#include "ranks/exchange.h"
#include "splotchcl/error.h"

namespace {

constexpr int failed = 1;        // the data or the device
constexpr int called_wrong = 2;  // the call or the scene

int run_alone(int argc, char** argv, splotchcl::cli::Console& console) {
  const int code = splotchcl::cli::run_command_line(argc, argv, console);
  std::cout.flush();
  if (!std::cout)
    throw splotchcl::DataError("standard output could not be written: is the disk full?");
  return code;
}

bool is_agreed(const std::exception& error) {
  return dynamic_cast<const splotchcl::AgreedFailure*>(&error) != nullptr;
}

// Tells what went wrong, and ends the processes that were started with this one.
int fail(const std::exception& error, const char* message, int code,
         splotchcl::cli::Console& console) {
  console.error(message);
  splotchcl::cli::leave_processes(code, is_agreed(error));
  return code;
}

int run(int argc, char** argv, splotchcl::cli::Console& console) {
  try {
    const int code = run_alone(argc, argv, console);
    splotchcl::cli::leave_processes(code, true);
    return code;
  } catch (const splotchcl::FailedElsewhere& elsewhere) {
    const int code = elsewhere.is_usage() ? called_wrong : failed;
    splotchcl::cli::leave_processes(code, true);
    return code;
  } catch (const splotchcl::UsageError& error) {
    return fail(error, error.what(), called_wrong, console);
  } catch (const std::bad_alloc& error) {
    return fail(error, "out of memory; fewer particles or a smaller picture need less", failed,
                console);
  } catch (const std::system_error& error) {
    const bool lacks_threads = error.code() == std::errc::resource_unavailable_try_again;
    return fail(error,
                lacks_threads ? "no thread can be started; end other programs, or raise the limit "
                                "on processes (ulimit -u)"
                              : error.what(),
                failed, console);
  } catch (const std::exception& error) {
    return fail(error, error.what(), failed, console);
  }
}

int run(int argc, char** argv) {
  splotchcl::cli::Console console;
  return run(argc, argv, console);
}

// What is opened next would take the place of a standard stream that is closed, and what is told
// would be written into it: batch systems and daemons start programs so.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest that is free, which is this one.
    if (::open("/dev/null", O_RDWR) != stream) ::_exit(failed);
  }
}

// PoCL compiles each kernel a second time, for its size of work-groups, unless it is told not to:
// two seconds of a first picture, for the same bits at the same speed.
void have_kernels_compiled_once() {
  constexpr int not_over_the_users = 0;
  ::setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", not_over_the_users);
}

// Without what libraries do when a program ends: HDF5 tries to close damaged files again and again,
// and says so.
[[noreturn]] void leave(int code) {
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  // A write beyond the limit on file sizes becomes an error that is reported like any other.
  std::signal(SIGXFSZ, SIG_IGN);
  splotchcl::guard_mapped_files();
  splotchcl::guard_crashes();
  splotchcl::let_errors_be_quiet();
  have_kernels_compiled_once();
  try {
    splotchcl::give_pocl_a_cache();
    leave(run(argc, argv));
  } catch (...) {
    // Not even a message has found memory.
    std::fputs("splotchcl: out of memory; fewer particles or a smaller picture need less\n",
               stderr);
    leave(failed);
  }
}
