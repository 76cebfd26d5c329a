#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl {

// What tells the content of a file from another: where it lies, its length and when it was written,
// to the nanosecond, which a file that is written anew, replaced or cut does not keep.
struct FileIdentity {
  std::uint64_t device = 0, node = 0, bytes = 0;
  std::int64_t written_ns = 0;  // since 1970
};
bool operator==(const FileIdentity& a, const FileIdentity& b);
inline bool operator!=(const FileIdentity& a, const FileIdentity& b) {
  return !(a == b);
}

// None where there is no regular file.
std::optional<FileIdentity> file_identity(const std::filesystem::path& path);

// "4711 bytes, written 2026-01-31 12:00:00.123456789 UTC"; "no file" where there is none.
std::string describe(const std::optional<FileIdentity>& file);

// A number that follows from what a file holds: of one beyond 16 MiB from stretches all over it.
// 0 where there is no regular file. Throws DataError where it cannot be read.
std::uint64_t content_mark(const std::filesystem::path& path);

// The marks of files that are asked for more than once.
class ContentMarks {
 public:
  std::uint64_t of(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, std::uint64_t> known_;
};

// Files that are to stay as they were when they were added.
class WatchedFiles {
 public:
  // What is watched already stays what it was; what is no regular file is left out.
  void add(const std::filesystem::path& file);
  // Throws DataError that says which one is another now.
  void check() const;
  // The same where one was written to: who has opened a file keeps it when it is removed, or when
  // another takes its name.
  void check_in_place() const;
  // What changes while it is read may fail anywhere: then that is what to tell.
  template <class Work>
  auto unchanged_during(const Work& work) const {
    try {
      return work();
    } catch (const Error&) {
      check_in_place();
      throw;
    }
  }

 private:
  static void check(const std::filesystem::path& file, const FileIdentity& expected,
                    const std::optional<FileIdentity>& found);

  std::map<std::filesystem::path, FileIdentity> files_;
};

}  // namespace splotchcl
