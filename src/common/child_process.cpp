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
#include <sstream>
#include <thread>

#include "common/unfinished_file.h"
#include "common/words.h"
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

bool is_program(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty() || folder.front() != '/') continue;
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (is_program(file)) return file.string();
  }
  return "";
}

ScratchText::ScratchText() {
  std::string name = (temporary_folder() / "splotchcl-XXXXXX").string();
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
  const bool is_path = words.front().find('/') != std::string::npos;
  const std::string file = is_path ? words.front() : find_program(words.front());
  if (file.empty()) throw DataError(words.front() + " cannot be started: " + reason(ENOENT));
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
  const int error =
      ::posix_spawn(&process_, file.c_str(), files.get(), &attributes, arguments.data(), environ);
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
