#include "snapshot/snapshot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <system_error>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {

namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 3> endings = {"", ".hdf5", ".h5"};

fs::path with_suffix(fs::path path, const std::string& suffix) {
  return path += suffix;
}

fs::path numbered_file(const MemberName& name, std::size_t number) {
  return with_suffix(name.base, fmt::format(".{}{}", number, name.ending));
}

}  // namespace

std::optional<MemberName> parse_member_name(const fs::path& path) {
  MemberName member;
  std::string name = path.filename().string();
  const std::string ending = path.extension().string();
  if (is_hdf5_ending(ending)) {
    member.ending = ending;
    name = path.stem().string();
  }
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return std::nullopt;
  const char* const first = name.data() + dot + 1;
  const char* const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, member.index);
  const bool has_leading_zero = last - first > 1 && *first == '0';
  if (error != std::errc() || end != last || member.index < 0 || has_leading_zero) {
    return std::nullopt;
  }
  member.base = path.parent_path() / name.substr(0, dot);
  return member;
}

std::optional<PathInFile> path_in_file(const fs::path& path) {
  constexpr int deepest = 16;
  fs::path group = path.filename(), file = path.parent_path();
  for (int depth = 0; depth < deepest && !group.empty() && file.has_filename(); ++depth) {
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) return PathInFile{file, group.string()};
    if (fs::exists(file, ignored)) return std::nullopt;
    group = file.filename() / group;
    file = file.parent_path();
  }
  return std::nullopt;
}

std::vector<fs::path> numbered_files(const MemberName& name, std::size_t most) {
  std::vector<fs::path> files;
  while (files.size() < most) {
    const fs::path file = numbered_file(name, files.size());
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) break;
    files.push_back(file);
  }
  return files;
}

std::vector<fs::path> find_members(const fs::path& member, int count) {
  if (count <= 1) return {member};
  const std::optional<MemberName> name = parse_member_name(member);
  const bool is_one_of_them = name && name->index < count;
  std::vector<fs::path> files;
  if (is_one_of_them) files = numbered_files(*name, static_cast<std::size_t>(count));
  if (files.size() == static_cast<std::size_t>(count)) return files;
  if (fs::is_symlink(member)) return find_members(fs::canonical(member), count);
  if (!is_one_of_them) {
    throw DataError(fmt::format(
        "{}: its header says that it is one of {} files, so its name should end in a number from "
        ".0 to .{}; give the files their original names",
        member.string(), count, count - 1));
  }
  throw DataError(fmt::format(
      "{}: missing, but the header of {} says that the snapshot has {} files; put all of them into "
      "the same folder",
      numbered_file(*name, files.size()).string(), member.filename().string(), count));
}

std::vector<fs::path> find_siblings(const fs::path& member) {
  const std::optional<MemberName> name = parse_member_name(member);
  std::vector<fs::path> files;
  if (name) files = numbered_files(*name);
  if (files.size() > 1 && static_cast<std::size_t>(name->index) < files.size()) return files;
  if (fs::is_symlink(member)) files = find_siblings(fs::canonical(member));
  return files.size() > 1 ? files : std::vector<fs::path>{member};
}

fs::path find_by_base_name(const fs::path& path) {
  std::vector<fs::path> found;
  std::vector<std::string> tried;
  for (const std::string number : {"", ".0"}) {
    for (const std::string ending : endings) {
      const fs::path candidate = with_suffix(path, number + ending);
      if (candidate == path) continue;
      tried.push_back(candidate.filename().string());
      if (fs::is_regular_file(candidate)) found.push_back(candidate);
    }
  }
  if (found.empty()) {
    throw DataError(fmt::format("{}: no such file or folder (nor {}); check the path",
                                path.string(), fmt::join(tried, ", ")));
  }
  if (found.size() > 1) {
    throw DataError(fmt::format("{}: could be {} or {}; give the full name of one", path.string(),
                                found[0].filename().string(), found[1].filename().string()));
  }
  return found.front();
}

const std::set<std::string>& ExistingFiles::names_in(const fs::path& folder) {
  const auto [found, is_new] = names_.try_emplace(folder);
  std::set<std::string>& names = found->second;
  std::error_code ignored;
  if (is_new && fs::is_directory(folder, ignored)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      names.insert(entry.path().filename().string());
  }
  return names;
}

std::vector<fs::path> ExistingFiles::files_of(const fs::path& path) {
  const std::set<std::string>& names = names_in(folder_of(path));
  const std::string own = path.filename().string();
  const std::optional<MemberName> member = parse_member_name(path.filename());
  const std::string base =
      member && names.count(own) > 0 ? member->base.string() : path.filename().string();
  std::vector<fs::path> files;
  // Of base.*, those that have a number; of base, which is no file, those that have an ending, too.
  for (auto name = names.lower_bound(base);
       name != names.end() && name->compare(0, base.size(), base) == 0; ++name) {
    const std::optional<MemberName> other = parse_member_name(*name);
    const bool is_member = other && other->base == base;
    const bool is_completed =
        names.count(own) == 0 && (*name == own + ".hdf5" || *name == own + ".h5");
    if (*name == own || is_member || is_completed) files.push_back(path.parent_path() / *name);
  }
  return files;
}

bool ExistingFiles::have(const fs::path& path) {
  if (path_in_file(path)) return true;  // whether it has the group is for its format to say
  const std::set<std::string>& names = names_in(folder_of(path));
  const std::string name = path.filename().string();
  if (name.empty()) return !names.empty();
  for (const std::string number : {"", ".0"}) {
    for (const std::string ending : endings) {
      if (names.count(name + number + ending) > 0) return true;
    }
  }
  return false;
}

WordHash hash_of_files(const SnapshotInfo& info) {
  WordHash hash;
  std::vector<fs::path> files = info.files;
  files.insert(files.end(), info.files_beside.begin(), info.files_beside.end());
  for (const fs::path& file : files) {
    std::error_code missing;
    hash.add(file.filename().string());
    hash.add(std::uint64_t{fs::file_size(file, missing)});
    const auto time = fs::last_write_time(file, missing).time_since_epoch();
    hash.add(static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(time).count()));
  }
  return hash;
}

bool has_files_as_opened(const SnapshotInfo& info) {
  return hash_of_files(info).value() == info.files_mark;
}

void check_files_are_the_same(const SnapshotInfo& info) {
  if (has_files_as_opened(info)) return;
  throw DataError(info.files.front().string() +
                  ": the snapshot was written anew, moved or removed since it was opened; open it "
                  "again when it is complete");
}

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
