#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace splotchcl {

// A text that another program writes and this one reads: a file without a name, so that nothing of
// it is left whatever happens.
class ScratchText {
 public:
  ScratchText();  // throws DataError
  ~ScratchText();
  ScratchText(const ScratchText&) = delete;
  ScratchText& operator=(const ScratchText&) = delete;

  int descriptor() const { return descriptor_; }
  // What has been written; of much the end.
  std::string text() const;

 private:
  int descriptor_ = -1;
};

// The program of this name, as an absolute path; "" where there is none. Of PATH only folders with
// absolute names are looked into: an empty or a relative one is the folder that is current, which
// may be anyone's.
std::string find_program(const std::string& name);

// Another program, by its path or as find_program finds it. In a process group of its own, so that
// Ctrl-C reaches this program alone, which then decides. It does not outlive the object.
class ChildProcess {
 public:
  // Descriptors that become the program's standard input, output and errors; -1: nothing is read,
  // and what is written is forgotten.
  struct Streams {
    int input = -1, output = -1, errors = -1;
  };
  // Throws DataError where it cannot be started.
  ChildProcess(const std::vector<std::string>& words, const Streams& streams);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class End { success, failure, stuck };
  // Waits for its end. It is stuck, and killed, when `progress` has returned the same number for
  // as long as `patience`.
  End wait(std::chrono::milliseconds patience, const std::function<std::uint64_t()>& progress);
  void kill();

 private:
  bool has_ended();

  pid_t process_ = -1;  // below 0: it has ended
  int status_ = -1;
};

}  // namespace splotchcl
