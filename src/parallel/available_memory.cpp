#include "parallel/available_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace splotchcl {
namespace {

std::uint64_t memory_of_machine() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::numeric_limits<std::uint64_t>::max() / 4;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
}

// The line "MemAvailable:   1234 kB".
std::optional<std::uint64_t> available_of_system() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  std::uint64_t kibibytes = 0;
  while (file >> name >> kibibytes) {
    std::getline(file, unit);
    if (name == "MemAvailable:") return kibibytes << 10;
  }
  return {};
}

std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  if (file >> number) return number;
  return {};  // "max" as well
}

// What a group's pages of files take, which the system takes back where it must.
std::uint64_t reclaimable(const std::string& folder) {
  std::ifstream file(folder + "/memory.stat");
  std::string name;
  std::uint64_t bytes = 0, sum = 0;
  while (file >> name >> bytes) {
    if (name == "active_file" || name == "inactive_file") sum += bytes;
  }
  return sum;
}

// Of a control group, in either version of them: the files' names differ.
std::optional<std::uint64_t> available_in(const std::string& folder, const char* limit,
                                          const char* usage) {
  const auto most = number_in(folder + "/" + limit), used = number_in(folder + "/" + usage);
  if (!most || !used) return {};
  const std::uint64_t kept = *used - std::min(*used, reclaimable(folder));
  return *most > kept ? *most - kept : 0;
}

// Lines "4:memory:/path" and "0::/path". A process in a container may see its own group as the
// root.
std::optional<std::uint64_t> available_of_group() {
  const std::string root = "/sys/fs/cgroup";
  std::ifstream file("/proc/self/cgroup");
  std::string line;
  std::optional<std::uint64_t> least;
  const auto take = [&least](std::optional<std::uint64_t> found) {
    if (found) least = std::min(*found, least.value_or(*found));
  };
  while (std::getline(file, line)) {
    const std::size_t path = line.find('/');
    if (path == std::string::npos) continue;
    if (line.find(":memory:") != std::string::npos) {
      for (const std::string& group : {line.substr(path), std::string()}) {
        take(available_in(root + "/memory" + group, "memory.limit_in_bytes",
                          "memory.usage_in_bytes"));
      }
    } else if (line.find("::") != std::string::npos) {
      for (const std::string& group : {line.substr(path), std::string()})
        take(available_in(root + group, "memory.max", "memory.current"));
    }
  }
  return least;
}

}  // namespace

std::uint64_t available_memory() {
  const std::uint64_t of_system = available_of_system().value_or(memory_of_machine());
  return std::min(of_system, available_of_group().value_or(of_system));
}

bool is_too_large_to_copy(std::uint64_t bytes) {
  // Less is never looked at: the answer is dear beside it.
  constexpr std::uint64_t small = 16u << 20;
  return bytes > small && bytes > available_memory() / 16;
}

}  // namespace splotchcl
