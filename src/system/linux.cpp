#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include "system/system.h"

namespace splotchcl::of_system {
namespace {

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

// "7f0c8000-7f0c9000 r-xp 00000000 08:01 1234   /usr/lib/libsplotchcl.so.0.1": the name where the
// address lies between both.
std::optional<std::string> name_around(const std::string& mapping, std::uintptr_t address) {
  unsigned long long first = 0, end = 0;
  if (std::sscanf(mapping.c_str(), "%llx-%llx", &first, &end) != 2) return std::nullopt;
  if (address < first || address >= end) return std::nullopt;
  const std::size_t name = mapping.find('/');
  if (name == std::string::npos) return std::nullopt;
  return mapping.substr(name);
}

// Empty where it cannot be read.
std::string content_of(const std::string& path) {
  std::ifstream file(path);
  std::string content;
  std::getline(file, content, '\0');  // a program's name may have ends of lines in it
  return content;
}

// Of /proc/PID/stat from the third on: the second is the program's name in parentheses, which may
// hold spaces and parentheses of its own. Empty where it cannot be read.
std::string fields_of(pid_t process) {
  const std::string fields = content_of("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = fields.rfind(')');
  return name_end == std::string::npos ? "" : fields.substr(name_end + 1);
}

// The field of that number; 0 where it is missing.
std::uint64_t number_in(const std::string& fields, int field) {
  std::istringstream rest(fields);
  std::string skipped;
  for (int before = 3; before < field; ++before)
    rest >> skipped;
  std::uint64_t number = 0;
  return rest >> number ? number : 0;
}

}  // namespace

std::optional<std::uint64_t> memory_left() {
  const std::optional<std::uint64_t> of_system = available_of_system();
  const std::optional<std::uint64_t> of_group = available_of_group();
  if (of_system && of_group) return std::min(*of_system, *of_group);
  return of_system ? of_system : of_group;
}

std::optional<std::uint64_t> address_space_in_use() {
  std::uint64_t pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return std::nullopt;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::optional<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return std::nullopt;
  return std::max(1, CPU_COUNT(&set));
}

std::uint64_t start_of_process(pid_t process) {
  constexpr int start = 22;
  return number_in(fields_of(process), start);
}

// A first thread that has ended looks the same while others go on.
bool is_only_number(pid_t process) {
  constexpr int threads = 20;
  const std::string fields = fields_of(process);
  const std::size_t state = fields.find_first_not_of(' ');
  const bool has_ended =
      state != std::string::npos && (fields[state] == 'Z' || fields[state] == 'X');
  return has_ended && number_in(fields, threads) <= 1;
}

std::string process_space() {
  std::array<char, 64> name = {};
  return ::readlink("/proc/self/ns/pid", name.data(), name.size() - 1) > 0 ? name.data() : "";
}

std::string machine_identity() {
  return content_of("/etc/machine-id");
}

// The system's own table, whose names are whole: the loader's are as a caller wrote them, that of a
// program what its first argument claims, and both may begin at a folder that is no longer current.
std::filesystem::path file_around(const void* address) {
  std::ifstream mappings("/proc/self/maps");
  for (std::string mapping; std::getline(mappings, mapping);) {
    const auto name = name_around(mapping, reinterpret_cast<std::uintptr_t>(address));
    if (name) return *name;
  }
  return {};
}

// Also where its file has been replaced.
std::filesystem::path own_program() {
  return "/proc/self/exe";
}

bool fill_with_chance(void* bytes, std::size_t count) {
  return ::getrandom(bytes, count, 0) == static_cast<ssize_t>(count);
}

bool connect_ends(int (&ends)[2]) {
  return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
}

bool open_pipe(int (&ends)[2]) {
  return ::pipe2(ends, O_CLOEXEC) == 0;
}

ssize_t send_without_signal(int socket, const void* bytes, std::size_t count, int flags) {
  return ::send(socket, bytes, count, flags | MSG_NOSIGNAL);
}

void drop_pipe_signal() {
  ::sigset_t pipe = {};
  ::sigemptyset(&pipe);
  ::sigaddset(&pipe, SIGPIPE);
  const timespec at_once = {};
  ::sigtimedwait(&pipe, nullptr, &at_once);
}

timespec written_at(const struct stat& file) {
  return file.st_mtim;
}

}  // namespace splotchcl::of_system
