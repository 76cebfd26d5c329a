#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <random>

#include "system/system.h"

namespace splotchcl::of_system {
namespace {

::sigset_t set_of_pipe() {
  ::sigset_t pipe = {};
  ::sigemptyset(&pipe);
  ::sigaddset(&pipe, SIGPIPE);
  return pipe;
}

// Closes both where that fails.
bool keep_from_children(const int (&ends)[2]) {
  const bool is_kept = std::all_of(std::begin(ends), std::end(ends),
                                   [](int end) { return ::fcntl(end, F_SETFD, FD_CLOEXEC) == 0; });
  if (!is_kept) std::for_each(std::begin(ends), std::end(ends), ::close);
  return is_kept;
}

}  // namespace

std::optional<std::uint64_t> memory_left() {
  return std::nullopt;
}

std::optional<std::uint64_t> address_space_in_use() {
  return std::nullopt;
}

std::optional<int> allowed_cores() {
  return std::nullopt;
}

std::uint64_t start_of_process(pid_t) {
  return 0;
}

bool is_only_number(pid_t) {
  return false;
}

std::string process_space() {
  return "";
}

std::string machine_identity() {
  return "";
}

// The loader's name, where it is whole: some loaders have for a program what its caller claims, and
// what begins at a folder may begin at a stranger's.
std::filesystem::path file_around(const void* address) {
  Dl_info found = {};
  if (::dladdr(address, &found) == 0 || found.dli_fname == nullptr) return {};
  const std::filesystem::path name = found.dli_fname;
  return name.is_absolute() ? name : std::filesystem::path();
}

std::filesystem::path own_program() {
  static const char here = 0;
  return file_around(&here);
}

bool fill_with_chance(void* bytes, std::size_t count) {
  std::random_device device;
  auto* const first = static_cast<unsigned char*>(bytes);
  std::generate(first, first + count, [&] { return static_cast<unsigned char>(device()); });
  return true;
}

bool connect_ends(int (&ends)[2]) {
  return ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0 && keep_from_children(ends);
}

bool open_pipe(int (&ends)[2]) {
  return ::pipe(ends) == 0 && keep_from_children(ends);
}

ssize_t send_without_signal(int socket, const void* bytes, std::size_t count, int flags) {
  const ::sigset_t pipe = set_of_pipe();
  ::sigset_t before = {};
  ::pthread_sigmask(SIG_BLOCK, &pipe, &before);
  const ssize_t sent = ::send(socket, bytes, count, flags);
  const int error = errno;
  if (sent < 0 && error == EPIPE) drop_pipe_signal();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return sent;
}

void drop_pipe_signal() {
  const ::sigset_t pipe = set_of_pipe();
  ::sigset_t waiting = {};
  int signal = 0;
  if (::sigpending(&waiting) == 0 && ::sigismember(&waiting, SIGPIPE) == 1)
    ::sigwait(&pipe, &signal);
}

timespec written_at(const struct stat& file) {
#ifdef __APPLE__
  return file.st_mtimespec;
#else
  return file.st_mtim;
#endif
}

}  // namespace splotchcl::of_system
