#pragma once

#include <sys/types.h>

#include <cstdint>
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

}  // namespace splotchcl
