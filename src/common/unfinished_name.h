#pragma once

#include <sys/types.h>

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

}  // namespace splotchcl
