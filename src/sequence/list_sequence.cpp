#include "sequence/list_sequence.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "formats/snapshot_format.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// A pattern of names of groups in a file.
struct StepPattern {
  fs::path file;
  std::string group;  // that they are in; empty: the root
  std::string name;   // with the conversion
};

std::size_t first_conversion(const std::string& pattern) {
  std::size_t percent = pattern.find('%');
  while (percent != std::string::npos && percent + 1 < pattern.size() &&
         pattern[percent + 1] == '%')
    percent = pattern.find('%', percent + 2);
  return percent;
}

std::optional<StepPattern> step_pattern(const std::string& pattern) {
  const std::size_t percent = first_conversion(pattern);
  const std::size_t slash = pattern.rfind('/', percent);
  if (percent == std::string::npos || slash == std::string::npos) return std::nullopt;
  const fs::path before = fill_pattern(pattern.substr(0, slash), 0);
  const std::string name = pattern.substr(slash + 1, pattern.find('/', percent) - slash - 1);
  std::error_code ignored;
  if (fs::is_regular_file(before, ignored)) return StepPattern{before, "", name};
  const auto within = path_in_file(before);
  if (!within) return std::nullopt;
  return StepPattern{within->file, within->group, name};
}

// The number with which the pattern is the name.
std::optional<int> number_in(const std::string& name, const std::string& pattern) {
  for (std::size_t i = name.find_first_of("0123456789"); i != std::string::npos;
       i = name.find_first_of("0123456789", i + 1)) {
    int number = 0;
    const char* const end = name.data() + name.size();
    if (std::from_chars(name.data() + i, end, number).ec != std::errc()) continue;
    if (fill_pattern(pattern, number) == name) return number;
  }
  return std::nullopt;
}

std::vector<ListedSnapshot> list_steps(const StepPattern& steps, const SequenceSettings& settings) {
  const SnapshotFormat* const format = find_format(steps.file);
  std::set<int> numbers;
  if (format != nullptr) {
    for (const std::string& name : format->groups_in(steps.file, steps.group)) {
      const auto number = number_in(name, steps.name);
      if (number) numbers.insert(*number);
    }
  }
  std::vector<ListedSnapshot> list;
  const int first = settings.first.value_or(0);
  const int last = settings.last.value_or(std::numeric_limits<int>::max());
  for (const int number : numbers) {
    if (number < first || number > last) continue;
    list.push_back({static_cast<double>(number), fill_pattern(settings.pattern, number)});
  }
  if (!list.empty()) return list;
  throw UsageError(
      fmt::format("time.snapshots: found no group {} in {} with a number from {} to {}, expected "
                  "steps in time; "
                  "check the pattern, time.first and time.last",
                  steps.name, steps.file.string(), first, last));
}

}  // namespace

std::vector<ListedSnapshot> list_sequence(const SequenceSettings& settings) {
  const auto steps = settings.pattern.empty() ? std::nullopt : step_pattern(settings.pattern);
  return steps ? list_steps(*steps, settings) : list_snapshots(settings);
}

}  // namespace splotchcl
