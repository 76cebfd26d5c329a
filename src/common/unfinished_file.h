#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace splotchcl {

// What tells the process that writes a file from all others, also of machines that share a folder
// and of later ones with its number.
struct WritingProcess {
  pid_t number = 0;
  std::uint64_t start = 0;  // in clock ticks, as /proc has it; 0: unknown
  std::string machine;      // letters, digits, '_' and '~' alone; empty: this one

  static WritingProcess own();
  bool is_of_this_machine() const;
  // Of this machine. What cannot be found out counts as running.
  bool is_running() const;
};

// The hidden name `.NAME.PID@START@HOST-N.part` that a file has until it is complete: who writes
// it, on which machine, and a number of its own. Of a long NAME it has a beginning and a checksum.
std::filesystem::path unfinished_name(const std::filesystem::path& target);

// The reverse: entries of a folder that are unfinished files of some targets there.
class UnfinishedNames {
 public:
  UnfinishedNames(const std::filesystem::path& folder, const std::set<std::string>& targets);
  // Whether it is one of them and nobody writes it any more: its process ran on this machine and
  // has ended, or it is of another machine and nothing has come to it for a week. Earlier versions'
  // `.NAME.PID-N.part` count as of this machine.
  bool has_leftover(const std::filesystem::path& entry) const;

 private:
  std::set<std::string> targets_;  // as they stand in unfinished names
};

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

// Where temporary files go. Throws DataError where TMPDIR names no folder.
std::filesystem::path temporary_folder();

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
