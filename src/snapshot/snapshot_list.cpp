#include "snapshot/snapshot_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

#include "common/folder_of.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace fs = std::filesystem;
namespace {

// Where the scene does not say which numbers there are.
constexpr int largest_number = 9999;

// A conversion of a pattern: %d with an optional width.
struct Conversion {
  std::size_t length = 0;  // in the pattern
  int width = 0;
  bool has_zeros = false;
};

std::optional<Conversion> read_conversion(const std::string& pattern, std::size_t percent) {
  Conversion conversion;
  std::size_t i = percent + 1;
  const auto is_digit = [&] {
    return i < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[i])) != 0;
  };
  if (i < pattern.size() && pattern[i] == '0') {
    conversion.has_zeros = true;
    ++i;
  }
  while (is_digit() && conversion.width < 100)
    conversion.width = 10 * conversion.width + (pattern[i++] - '0');
  if (i >= pattern.size() || pattern[i] != 'd') return std::nullopt;
  conversion.length = i + 1 - percent;
  return conversion;
}

// What a pattern is before its first number: the folder, and how names in it begin.
struct PatternStart {
  fs::path folder;
  std::string name;
};

PatternStart start_of(const std::string& pattern) {
  std::size_t end = pattern.find('%');
  while (pattern[end + 1] == '%')
    end = pattern.find('%', end + 2);
  const fs::path start = fill_pattern(pattern.substr(0, end), 0);
  return {folder_of(start), start.filename().string()};
}

// Which number a name has where it is to be is not always plain: of s_120 12, where the pattern is
// s_%d0. So all that its digits may be are looked up.
void add_numbers(const std::string& name, std::size_t begin, std::set<int>& numbers) {
  constexpr int most_digits = 10;
  while (begin < name.size() && name[begin] == ' ')
    ++begin;
  std::size_t zeros_end = begin;
  while (zeros_end < name.size() && name[zeros_end] == '0')
    ++zeros_end;
  if (zeros_end > begin) numbers.insert(0);
  std::int64_t number = 0;
  for (std::size_t i = zeros_end; i < name.size() && i < zeros_end + most_digits; ++i) {
    if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) return;
    number = 10 * number + (name[i] - '0');
    if (number > std::numeric_limits<int>::max()) return;
    numbers.insert(static_cast<int>(number));
  }
}

// Those that snapshots of a pattern can have, from the names that there are.
std::set<int> possible_numbers(const std::string& pattern, ExistingFiles& existing) {
  const PatternStart start = start_of(pattern);
  std::set<int> numbers;
  for (const std::string& name : existing.names_in(start.folder)) {
    if (name.compare(0, start.name.size(), start.name) == 0)
      add_numbers(name, start.name.size(), numbers);
  }
  return numbers;
}

std::vector<ListedSnapshot> numbered_snapshots(const SequenceSettings& settings) {
  const int first = settings.first.value_or(0);
  const int last = settings.last.value_or(std::max(first, largest_number));
  ExistingFiles existing;
  std::vector<ListedSnapshot> list;
  for (const int number : possible_numbers(settings.pattern, existing)) {
    if (number < first || number > last) continue;
    const fs::path path = fill_pattern(settings.pattern, number);
    if (existing.have(path)) list.push_back({static_cast<double>(number), path});
  }
  if (list.empty()) {
    throw UsageError(
        fmt::format("time.snapshots: found no file {} with a number from {} to {}, expected "
                    "snapshots; check the pattern, time.first and time.last",
                    settings.pattern, first, last));
  }
  return list;
}

}  // namespace

bool is_snapshot_pattern(const std::string& text) {
  bool has_number = false;
  for (std::size_t i = text.find('%'); i != std::string::npos; i = text.find('%', i)) {
    if (i + 1 < text.size() && text[i + 1] == '%') {
      i += 2;
      continue;
    }
    const auto conversion = read_conversion(text, i);
    if (!conversion) return false;
    has_number = true;
    i += conversion->length;
  }
  return has_number;
}

std::string fill_pattern(const std::string& pattern, int number) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size();) {
    if (pattern[i] != '%') {
      text += pattern[i++];
    } else if (const auto conversion = read_conversion(pattern, i)) {
      text += conversion->has_zeros ? fmt::format("{:0{}d}", number, conversion->width)
                                    : fmt::format("{:{}d}", number, conversion->width);
      i += conversion->length;
    } else {
      text += '%';
      i += 2;
    }
  }
  return text;
}

std::string as_pattern(const std::string& path) {
  std::string pattern;
  for (const char c : path)
    pattern += c == '%' ? "%%" : std::string(1, c);
  return pattern;
}

std::vector<ListedSnapshot> list_snapshots(const SequenceSettings& settings) {
  if (!settings.pattern.empty()) return numbered_snapshots(settings);
  ExistingFiles existing;
  std::vector<ListedSnapshot> list;
  for (const std::string& path : settings.snapshots) {
    if (!existing.have(path)) {
      throw UsageError(fmt::format(
          "time.snapshots: found no file {}, expected a snapshot; check the path", path));
    }
    list.push_back({static_cast<double>(list.size()), path});
  }
  return list;
}

SequencePlace find_place(const std::vector<ListedSnapshot>& list, double index) {
  if (!(index >= list.front().index && index <= list.back().index)) {
    throw UsageError(fmt::format("time.index is {}, expected a number from {} ({}) to {} ({})",
                                 index, list.front().index, list.front().path.string(),
                                 list.back().index, list.back().path.string()));
  }
  const auto after =
      std::upper_bound(list.begin(), list.end(), index,
                       [](double i, const ListedSnapshot& listed) { return i < listed.index; });
  const auto before = std::prev(after);
  SequencePlace place;
  place.snapshot = static_cast<std::size_t>(before - list.begin());
  if (after != list.end())
    place.fraction = (index - before->index) / (after->index - before->index);
  return place;
}

}  // namespace splotchcl
