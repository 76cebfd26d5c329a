#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace splotchcl {

// Creates a file beside `path` and removes it. Throws DataError when that fails: the folder
// is missing or not writable, or `path` is itself a folder.
void check_output_path(const std::filesystem::path& path);

// Removes the unfinished files of these names that killed processes left in a folder. Those of
// processes that still run here stay.
void remove_leftovers(const std::filesystem::path& folder, const std::set<std::string>& names);

// A file that appears under its name only when it is complete. Until finish() it has a
// temporary name in the same folder, and is removed when it is abandoned. A symbolic link
// stays: what it points to is replaced. Throws DataError.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  void write(const void* data, std::size_t bytes);
  // For libraries that write a file by its name; they must be done with it at finish().
  const std::filesystem::path& temporary_path() const { return temporary_; }
  void finish();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;    // as the user named it, for messages
  std::filesystem::path target_;  // where it will be
  std::filesystem::path temporary_;
  int descriptor_ = -1;
};

}  // namespace splotchcl
