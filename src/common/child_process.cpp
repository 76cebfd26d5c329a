#include "common/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "common/reason.h"
#include "splotchcl/error.h"

extern char** environ;

namespace splotchcl {
namespace {

class FileActions {
 public:
  FileActions() { ::posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void use(int descriptor, int as, int mode) {
    if (descriptor >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, descriptor, as);
    } else {
      ::posix_spawn_file_actions_addopen(&actions_, as, "/dev/null", mode, 0);
    }
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

ScratchText::ScratchText() {
  std::string name = (std::filesystem::temp_directory_path() / "splotchcl-XXXXXX").string();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) throw DataError(name + ": cannot be created: " + reason(errno));
  ::unlink(name.c_str());
}

ScratchText::~ScratchText() {
  ::close(descriptor_);
}

std::string ScratchText::text() const {
  constexpr std::size_t longest = 1 << 16;
  std::string text(longest, '\0');
  struct stat status = {};
  ::fstat(descriptor_, &status);
  const off_t first = std::max<off_t>(0, status.st_size - static_cast<off_t>(longest));
  const ssize_t length = ::pread(descriptor_, text.data(), text.size(), first);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, length)));
  return text;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words, const Streams& streams) {
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  FileActions files;
  files.use(streams.input, STDIN_FILENO, O_RDONLY);
  files.use(streams.output, STDOUT_FILENO, O_WRONLY);
  files.use(streams.errors, STDERR_FILENO, O_WRONLY);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = ::posix_spawnp(&process_, words.front().c_str(), files.get(), &attributes,
                                   arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (error == 0) return;
  process_ = -1;
  throw DataError(words.front() + " cannot be started: " + reason(error));
}

ChildProcess::~ChildProcess() {
  kill();
}

bool ChildProcess::has_ended() {
  if (process_ < 0) return true;
  const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
  if (ended < 0) status_ = -1;  // somebody else has waited for it
  process_ = -1;
  return true;
}

ChildProcess::End ChildProcess::wait(std::chrono::milliseconds patience,
                                     const std::function<std::uint64_t()>& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds longest_nap(50);
  std::chrono::milliseconds nap(1);
  std::uint64_t last = progress();
  Clock::time_point last_change = Clock::now();
  while (!has_ended()) {
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, longest_nap);
    const std::uint64_t now = progress();
    if (now != last) {
      last = now;
      last_change = Clock::now();
    } else if (Clock::now() - last_change > patience) {
      kill();
      return End::stuck;
    }
  }
  return WIFEXITED(status_) && WEXITSTATUS(status_) == 0 ? End::success : End::failure;
}

void ChildProcess::kill() {
  if (process_ < 0) return;
  ::kill(-process_, SIGKILL);  // and what it has started itself
  while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

}  // namespace splotchcl
