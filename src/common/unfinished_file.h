#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace splotchcl {

// Creates a file beside `path` and removes it, and what killed processes left unfinished of that
// name. Throws DataError when that fails: the folder is missing or not writable, or `path` is
// itself a folder. Of a FIFO or a device only asks whether it may be written.
void check_output_path(const std::filesystem::path& path);

// Removes the unfinished files of these names that killed processes left in a folder. Those of
// processes that still run stay, and so do those of other machines until they are a week old.
void remove_leftovers(const std::filesystem::path& folder, const std::set<std::string>& names);

// What a signal handler may call before it ends the program: removes all unfinished files of this
// process. Beyond 64 at a time they stay.
void remove_unfinished_files() noexcept;

// A file that appears under its name only when it is complete. Until finish() it has a
// temporary name in the same folder, and is removed when it is abandoned. A symbolic link
// stays: what it points to is replaced. What is no regular file, such as a FIFO or a device, is not
// replaced: finish() writes into it what has been kept in the folder for temporary files. Throws
// DataError.
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
  // The same, but what has come under its name meanwhile stays. Returns whether nothing had. No
  // stream.
  bool finish_unless_there();

 private:
  void close_file();
  void copy_into_stream();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;    // as the user named it, for messages
  bool is_stream_;                // a FIFO or a device
  std::filesystem::path target_;  // where it will be
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  int place_ = -1;  // among the names that a signal handler removes
};

}  // namespace splotchcl
