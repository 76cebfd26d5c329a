#include "snapshot/snapshot_files.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <system_error>

#include "common/folder_of.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 3> endings = {"", ".hdf5", ".h5"};

fs::path with_suffix(fs::path path, const std::string& suffix) {
  return path += suffix;
}

}  // namespace

std::optional<MemberName> parse_member_name(const fs::path& path) {
  MemberName member;
  std::string name = path.filename().string();
  for (const std::string ending : {".hdf5", ".h5"}) {
    if (name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
      member.ending = ending;
      name.resize(name.size() - ending.size());
      break;
    }
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
  std::error_code ignored;
  const bool leads_into_file =
      path.has_filename() && fs::is_regular_file(path.parent_path(), ignored);
  if (!leads_into_file) return std::nullopt;
  return PathInFile{path.parent_path(), path.filename().string()};
}

std::vector<fs::path> find_members(const fs::path& member, int count) {
  if (count <= 1) return {member};
  const std::optional<MemberName> name = parse_member_name(member);
  if (!name || name->index >= count) {
    throw DataError(fmt::format(
        "{}: its header says that it is one of {} files, so its name should end in a number from "
        ".0 to .{}; give the files their original names",
        member.string(), count, count - 1));
  }
  std::vector<fs::path> members;
  for (int i = 0; i < count; ++i) {
    const fs::path path = with_suffix(name->base, fmt::format(".{}{}", i, name->ending));
    if (!fs::is_regular_file(path)) {
      throw DataError(fmt::format(
          "{}: missing, but the header of {} says that the snapshot has {} files; put all of them "
          "into the same folder",
          path.string(), member.filename().string(), count));
    }
    members.push_back(path);
  }
  return members;
}

std::vector<fs::path> find_siblings(const fs::path& member) {
  const std::optional<MemberName> name = parse_member_name(member);
  std::vector<fs::path> siblings;
  while (name) {
    const fs::path path =
        with_suffix(name->base, fmt::format(".{}{}", siblings.size(), name->ending));
    if (!fs::is_regular_file(path)) break;
    siblings.push_back(path);
  }
  const bool is_one_of_them = name && static_cast<std::size_t>(name->index) < siblings.size();
  return is_one_of_them ? siblings : std::vector<fs::path>{member};
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

void check_files_are_the_same(const SnapshotInfo& info) {
  if (hash_of_files(info).value() == info.files_mark) return;
  throw DataError(info.files.front().string() +
                  ": the snapshot was written anew, moved or removed since it was opened; open it "
                  "again when it is complete");
}

}  // namespace splotchcl
