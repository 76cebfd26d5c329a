#include "common/unfinished_name.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <optional>
#include <random>
#include <string_view>

#include "common/folders.h"
#include "scene/hash.h"
#include "system/system.h"

namespace splotchcl {
namespace {

std::string host_name() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Readable, and different also for machines whose names are alike: "localhost".
std::string name_of_machine() {
  constexpr std::size_t readable_letters = 16;
  const std::string host = host_name();
  WordHash hash;
  hash.add(host);
  hash.add(of_system::process_space());
  hash.add(of_system::machine_identity());
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
  return {::getpid(), of_system::start_of_process(::getpid()), name_of_machine()};
}

bool WritingProcess::is_of_this_machine() const {
  return machine.empty() || machine == name_of_machine();
}

bool WritingProcess::is_running() const {
  if (::kill(number, 0) != 0 && errno == ESRCH) return false;
  const std::uint64_t start_now = start == 0 ? 0 : of_system::start_of_process(number);
  return start_now == 0 || start_now == start;
}

namespace {

constexpr std::string_view end_of_name = ".part";

std::size_t longest_name_in(const std::filesystem::path& folder) {
  constexpr long usual = 255;
  const long longest = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  return static_cast<std::size_t>(longest > 0 ? longest : usual);
}

bool continues_a_letter(char byte) {  // of UTF-8
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// The target's name as a part of an unfinished one, which is at most as long as the file system
// allows.
std::string shortened_name(const std::string& name, std::size_t longest) {
  // The dots, ten digits of a process, twenty of its start, 25 letters of a machine, ten digits.
  constexpr std::size_t others = 80, checksum_letters = 17;
  if (name.size() + others <= longest) return name;
  std::size_t kept = longest > others + checksum_letters ? longest - others - checksum_letters : 0;
  while (kept > 0 && continues_a_letter(name[kept]))
    --kept;
  WordHash hash;
  hash.add(name);
  return fmt::format("{}~{:016x}", name.substr(0, kept), hash.value());
}

template <typename Number>
std::optional<Number> read_number(std::string_view text) {
  Number number = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || next != text.data() + text.size()) {
    return std::nullopt;
  }
  return number;
}

// PID@START@HOST, or the PID of earlier versions.
std::optional<WritingProcess> read_process(std::string_view text) {
  WritingProcess process;
  const std::size_t first = text.find('@');
  const auto number = read_number<pid_t>(text.substr(0, first));
  if (!number || *number <= 0) return std::nullopt;
  process.number = *number;
  if (first == std::string_view::npos) return process;
  const std::size_t second = text.find('@', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto start = read_number<std::uint64_t>(text.substr(first + 1, second - first - 1));
  process.machine = text.substr(second + 1);
  if (!start || process.machine.empty()) return std::nullopt;
  process.start = *start;
  return process;
}

struct UnfinishedName {
  std::string target;  // as shortened_name() has it
  WritingProcess process;
};

std::optional<UnfinishedName> read_name(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  const bool is_one =
      name.size() > end_of_name.size() && name.front() == '.' &&
      name.compare(name.size() - end_of_name.size(), end_of_name.size(), end_of_name) == 0;
  if (!is_one || dash == std::string::npos) return std::nullopt;
  const std::size_t dot = name.rfind('.', dash);
  if (dot == 0 || dot == std::string::npos) return std::nullopt;
  const auto process = read_process(std::string_view(name).substr(dot + 1, dash - dot - 1));
  if (!process) return std::nullopt;
  return UnfinishedName{name.substr(1, dot - 1), *process};
}

// Long enough for whatever clocks of machines differ by, and for programs that are stopped over a
// weekend.
bool is_old(const std::filesystem::path& file) {
  constexpr std::chrono::hours week(7 * 24);
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && std::filesystem::file_time_type::clock::now() - written > week;
}

}  // namespace

std::filesystem::path unfinished_name(const std::filesystem::path& target) {
  const WritingProcess process = WritingProcess::own();
  const std::string name =
      shortened_name(target.filename().string(), longest_name_in(folder_of(target)));
  return fmt::format(".{}.{}@{}@{}-{}{}", name, process.number, process.start, process.machine,
                     std::random_device()(), end_of_name);
}

UnfinishedNames::UnfinishedNames(const std::filesystem::path& folder,
                                 const std::set<std::string>& targets)
    : targets_(targets) {  // earlier versions shortened none
  const std::size_t longest = longest_name_in(folder);
  for (const std::string& target : targets)
    targets_.insert(shortened_name(target, longest));
}

bool UnfinishedNames::has_leftover(const std::filesystem::path& entry) const {
  const std::optional<UnfinishedName> file = read_name(entry.filename().string());
  if (!file || targets_.count(file->target) == 0) return false;
  return file->process.is_of_this_machine() ? !file->process.is_running() : is_old(entry);
}

}  // namespace splotchcl
