#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "common/writing_process.h"

namespace splotchcl {

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
