#include "common/writing_process.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>

#include "scene/word_hash.h"

namespace splotchcl {
namespace {

// Empty where it cannot be read.
std::string content_of(const std::string& path) {
  std::ifstream file(path);
  std::string content;
  std::getline(file, content, '\0');  // a program's name may have ends of lines in it
  return content;
}

// The 22nd field of /proc/PID/stat; 0: cannot be read. The second is the program's name in
// parentheses, which may hold spaces and parentheses of its own.
std::uint64_t start_of(pid_t process) {
  const std::string fields = content_of(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = fields.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream rest(fields.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field)
    rest >> skipped;
  std::uint64_t start = 0;
  return rest >> start ? start : 0;
}

std::string host_name() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Containers with numbers of processes of their own.
std::string process_space() {
  std::array<char, 64> name = {};
  return ::readlink("/proc/self/ns/pid", name.data(), name.size() - 1) > 0 ? name.data() : "";
}

// Readable, and different also for machines whose names are alike: "localhost".
std::string name_of_machine() {
  constexpr std::size_t readable_letters = 16;
  const std::string host = host_name();
  WordHash hash;
  hash.add(host);
  hash.add(process_space());
  hash.add(content_of("/etc/machine-id"));
  std::string readable = host.substr(0, readable_letters);
  const auto is_plain = [](char letter) {
    return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z');
  };
  std::replace_if(
      readable.begin(), readable.end(), [&](char letter) { return !is_plain(letter); }, '_');
  return fmt::format("{}~{:08x}", readable, static_cast<std::uint32_t>(hash.value() >> 32));
}

}  // namespace

WritingProcess WritingProcess::own() {
  return {::getpid(), start_of(::getpid()), name_of_machine()};
}

bool WritingProcess::is_of_this_machine() const {
  return machine.empty() || machine == name_of_machine();
}

bool WritingProcess::is_running() const {
  if (::kill(number, 0) != 0 && errno == ESRCH) return false;
  const std::uint64_t start_now = start == 0 ? 0 : start_of(number);
  return start_now == 0 || start_now == start;
}

}  // namespace splotchcl
