#include "process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "splotchcl/error.h"

namespace splotchcl::bench {
namespace {

class SilentOutput {
 public:
  SilentOutput() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~SilentOutput() { posix_spawn_file_actions_destroy(&actions_); }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

ProcessCost run_process(const std::vector<std::string>& words) {
  std::vector<std::string> copies = words;
  std::vector<char*> pointers;
  for (std::string& word : copies)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const SilentOutput output;
  const Stopwatch stopwatch;
  pid_t child = 0;
  if (posix_spawnp(&child, pointers[0], output.get(), nullptr, pointers.data(), environ) != 0) {
    throw DataError(words[0] + ": cannot be started; check the path");
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::string call;
    for (const std::string& word : words)
      call += (call.empty() ? "" : " ") + word;
    throw DataError("failed: " + call);
  }
  ProcessCost result;
  result.cost = {stopwatch.elapsed().wall_seconds, cpu_seconds(usage)};
  result.largest_resident_bytes = 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
  return result;
}

std::uint64_t anonymous_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "RssAnon:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

}  // namespace splotchcl::bench
