#include "splotchcl/untrusted_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <new>
#include <optional>
#include <string>
#include <system_error>

#include "common/guards.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/snapshot.h"
#include "system/system.h"
#include "untrusted/untrusted_file.h"

namespace splotchcl {
namespace {

// What the child says at its end: one of these, and the text of an error.
constexpr char done = 'd', wrong_call = 'u', bad_data = 'b', no_memory = 'm';

void say(int descriptor, char what, const std::string& text = "") {
  const std::string message = what + text;
  std::size_t sent = 0;
  while (sent < message.size()) {
    const ssize_t written = ::write(descriptor, message.data() + sent, message.size() - sent);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) sent += static_cast<std::size_t>(written);
  }
}

// Crashes are the child's own: the caller's handlers, which may tidy up after the caller, stay out
// of it, and no core is written.
void limit_child(const ChildLimits& limits) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM})
    ::signal(signal, SIG_DFL);
  ::sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::alarm(static_cast<unsigned>(limits.seconds));
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Address space is what can be limited.
  const std::optional<std::uint64_t> in_use = of_system::address_space_in_use();
  if (limits.memory_bytes == 0 || !in_use) return;
  const auto most = static_cast<rlim_t>(*in_use + limits.memory_bytes);
  const rlimit memory = {most, most};
  ::setrlimit(RLIMIT_AS, &memory);
}

[[noreturn]] void be_child(int answer, const std::function<void()>& task,
                           const ChildLimits& limits) {
  // Libraries' own lines.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  try {
    limit_child(limits);
    task();
    say(answer, done);
  } catch (const UsageError& error) {
    say(answer, wrong_call, error.what());
  } catch (const std::bad_alloc&) {
    say(answer, no_memory);
  } catch (const std::exception& error) {
    say(answer, bad_data, error.what());
  }
  // Nothing of the caller's is tidied up here.
  ::_exit(0);
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> bytes;
  for (;;) {
    const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

// 0 where nobody can tell, since the caller lets the system wait for its children.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 0;
  }
  return status;
}

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw DataError(name + ": cannot be read safely: a child process that read it " + what);
}

[[noreturn]] void fail_to_start(const std::string& name) {
  throw DataError(name + ": cannot be checked: no child process could be started: " +
                  std::generic_category().message(errno) + "; end other programs");
}

void judge(const std::string& name, const std::string& answer, int status,
           const ChildLimits& limits) {
  const char what = answer.empty() ? '\0' : answer.front();
  if (what == done) return;
  if (what == wrong_call) throw UsageError(answer.substr(1));
  if (what == bad_data) throw DataError(answer.substr(1));
  if (what == no_memory) {
    fail(name, "needed more than " + std::to_string(limits.memory_bytes >> 20) +
                   " MiB of memory; allow more if the file is to be trusted");
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    fail(name, "did not end in " + std::to_string(limits.seconds) +
                   " s; allow more if the file is to be trusted");
  }
  fail(name, "crashed; the file is damaged: copy or write it again");
}

}  // namespace

void run_in_child(const std::string& name, const std::function<void()>& task,
                  const ChildLimits& limits) {
  if (limits.seconds < 1) {
    throw UsageError("ChildLimits: found " + std::to_string(limits.seconds) +
                     " seconds, expected at least 1");
  }
  int ends[2] = {};
  if (!of_system::open_pipe(ends)) fail_to_start(name);
  const pid_t child = ::fork();
  if (child == 0) be_child(ends[1], task, limits);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    fail_to_start(name);
  }
  const std::string answer = read_all(ends[0]);
  ::close(ends[0]);
  judge(name, answer, wait_for(child), limits);
}

LiveFiles::LiveFiles() {
  survive_cut_files();
  cut_before_ = cut_file_count();
}

void LiveFiles::require_whole() const {
  if (cut_file_count() == cut_before_) return;
  throw DataError(std::string(last_cut_file()) +
                  ": became shorter while it was read; wait until it is completely written and try "
                  "again");
}

namespace {

void read_everything(const Snapshot& snapshot) {
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    for (const FieldInfo& field : type.fields) {
      // Mapped files are read when they are looked at.
      const Column column = snapshot.read(type.type, field.name);
      volatile float seen = 0;
      for (std::size_t i = 0; i < column.size(); ++i)
        seen = column[i];
      static_cast<void>(seen);
    }
    try {
      static_cast<void>(snapshot.read_ids(type.type));
    } catch (const Error&) {
      // A file need not have any, and a scene that asks for them is told what is wrong.
    }
  }
}

}  // namespace

void check_untrusted_snapshot(const std::filesystem::path& path, const SnapshotOptions& options,
                              const ChildLimits& limits) {
  run_in_child(
      path.string(), [&] { read_everything(*open_snapshot(path, options)); }, limits);
}

void check_untrusted_image(const std::filesystem::path& path, const ChildLimits& limits) {
  run_in_child(
      path.string(), [&] { static_cast<void>(read_image(path)); }, limits);
}

}  // namespace splotchcl
