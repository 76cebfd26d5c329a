#include "common/crash_guard.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "common/quiet_errors.h"
#include "common/unfinished_file.h"

namespace splotchcl {
namespace {

std::atomic<bool> may_exit = false;
pid_t guarded_process = 0;

// Only what POSIX lets a signal handler do: no memory, no streams.
extern "C" void handle_crash(int) {
  constexpr char text[] =
      "splotchcl: a library failed so that the program had to end: most likely memory ran out, or "
      "a "
      "file is damaged; try fewer particles, a smaller picture, or another copy of the file\n";
  remove_unfinished_files();
  static_cast<void>(!::write(error_descriptor(), text, std::strlen(text)));
  ::_exit(1);
}

// The program itself never calls exit(); HDF5 does where memory runs out, without a word.
extern "C" void handle_exit() {
  if (!may_exit && ::getpid() == guarded_process) handle_crash(0);
}

}  // namespace

void let_libraries_exit() {
  may_exit = true;
}

void guard_crashes() {
  if (std::getenv("SPLOTCHCL_CORE") != nullptr) return;
  // A stack that has run out cannot hold the handler's frame.
  static std::array<char, 64 * 1024> memory;
  stack_t stack = {};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action = {};
  action.sa_handler = handle_crash;
  action.sa_flags = SA_ONSTACK;
  ::sigemptyset(&action.sa_mask);
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGILL})
    ::sigaction(signal, &action, nullptr);
  // The usual one has lines of its own before it aborts, and while OpenCL's compiler is loaded in
  // another thread its handler of that signal is in the place of ours.
  std::set_terminate([] { handle_crash(SIGABRT); });
  guarded_process = ::getpid();
  std::atexit(handle_exit);
}

}  // namespace splotchcl
