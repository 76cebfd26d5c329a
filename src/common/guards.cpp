#include "common/guards.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>

#include "common/unfinished_file.h"

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

namespace {

struct Mapping {
  std::atomic<const std::byte*> begin{nullptr};  // set last, cleared first
  std::atomic<std::uint64_t> size{0};
  std::atomic<const char*> path{nullptr};
  std::atomic<bool> is_taken{false};
  std::atomic<bool> is_cut{false};
};

std::array<Mapping, 1024>& mappings() {
  static std::array<Mapping, 1024> all;
  return all;
}

// Only what POSIX lets a signal handler do: no memory, no streams.
void say(const char* text) {
  static_cast<void>(!::write(error_descriptor(), text, std::strlen(text)));
}

void say(std::uint64_t number) {
  char digits[24];
  char* first = digits + sizeof digits - 1;
  *first = '\0';
  do {
    *--first = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  say(first);
}

// Without the characters that a terminal would obey, some of which have two bytes in UTF-8.
void say_name(const char* name) {
  unsigned before = 0;
  for (; *name != '\0'; ++name) {
    const auto byte = static_cast<unsigned char>(*name);
    const bool is_obeyed = byte < 0x20 || byte == 0x7f || (before == 0xc2 && byte < 0xa0);
    const char shown[] = {is_obeyed ? '?' : *name, '\0'};
    say(shown);
    before = byte;
  }
}

void end_for_shrunken_file(const Mapping& mapping) {
  const char* const path = mapping.path.load();
  struct stat status = {};
  const bool is_known = ::stat(path, &status) == 0;
  say("splotchcl: ");
  say_name(path);
  say(": became shorter while it was read: found ");
  say(is_known ? static_cast<std::uint64_t>(status.st_size) : 0);
  say(" bytes, expected ");
  say(mapping.size.load());
  say("; wait until it is completely written and try again\n");
  remove_unfinished_files();
  ::_exit(1);
}

Mapping* find_mapping(const siginfo_t& info) {
  const auto* const place = static_cast<const std::byte*>(info.si_addr);
  for (Mapping& mapping : mappings()) {
    const std::byte* const begin = mapping.begin.load();
    if (begin != nullptr && place >= begin && place < begin + mapping.size.load()) return &mapping;
  }
  return nullptr;
}

extern "C" void handle_bus_error(int signal, siginfo_t* info, void*) {
  if (const Mapping* const mapping = find_mapping(*info)) end_for_shrunken_file(*mapping);
  ::signal(signal,
           SIG_DFL);  // no file of ours: on return the signal comes again, and ends the program
}

struct Survival {
  std::atomic<std::uint64_t> cuts{0};
  std::array<char, 4096> last_path{};  // the mapping may be gone when somebody asks
  struct sigaction before = {};
  std::uintptr_t page = 0;
};

Survival& survival() {
  static Survival state;
  return state;
}

// Zeros from the place of the signal to the end of the mapping.
bool put_zeros(const Mapping& mapping, const siginfo_t& info) {
  const auto place = reinterpret_cast<std::uintptr_t>(info.si_addr) & ~(survival().page - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(mapping.begin.load()) + mapping.size.load();
  return ::mmap(reinterpret_cast<void*>(place), end - place, PROT_READ,
                MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
}

extern "C" void survive_bus_error(int signal, siginfo_t* info, void*) {
  Mapping* const mapping = find_mapping(*info);
  if (mapping != nullptr && put_zeros(*mapping, *info)) {
    std::strncpy(survival().last_path.data(), mapping->path.load(),
                 survival().last_path.size() - 1);
    mapping->is_cut = true;
    ++survival().cuts;
    return;
  }
  ::sigaction(signal, &survival().before, nullptr);  // the signal comes again
}

}  // namespace

void survive_cut_files() {
  mappings();  // made before a handler needs it
  struct sigaction now = {};
  ::sigaction(SIGBUS, nullptr, &now);
  if ((now.sa_flags & SA_SIGINFO) != 0 && now.sa_sigaction == survive_bus_error) return;
  survival().before = now;
  survival().page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  struct sigaction action = {};
  action.sa_sigaction = survive_bus_error;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGBUS, &action, nullptr);
}

std::uint64_t cut_file_count() {
  return survival().cuts;
}

const char* last_cut_file() {
  return cut_file_count() == 0 ? nullptr : survival().last_path.data();
}

bool is_cut(const std::byte* begin) {
  for (const Mapping& mapping : mappings()) {
    if (mapping.begin.load() == begin) return mapping.is_cut;
  }
  return false;
}

void guard_mapped_files() {
  mappings();  // made before a handler needs it
  struct sigaction action = {};
  action.sa_sigaction = handle_bus_error;
  action.sa_flags = SA_SIGINFO;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGBUS, &action, nullptr);
}

void register_mapping(const std::byte* begin, std::uint64_t size, const char* path) {
  for (Mapping& mapping : mappings()) {
    if (mapping.is_taken.exchange(true)) continue;
    mapping.is_cut = false;
    mapping.size = size;
    mapping.path = path;
    mapping.begin = begin;
    return;
  }
}

void forget_mapping(const std::byte* begin) {
  for (Mapping& mapping : mappings()) {
    if (mapping.begin.load() != begin) continue;
    mapping.begin = nullptr;
    mapping.is_taken = false;
    return;
  }
}

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
