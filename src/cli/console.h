#pragma once

#include <chrono>
#include <memory>
#include <string>

namespace splotchcl::cli {

// The text with a question mark for each control character: names in a file may hold any, and
// a terminal obeys them.
std::string printable(std::string text);

// What goes to standard error: notes and errors, a line each, and on a terminal a status
// line that is overwritten and finally removed. In a pipe there is no status.
class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void note(const std::string& text);   // splotchcl: note: text
  void error(const std::string& text);  // splotchcl: text
  void status(const std::string& text);
  void progress(const std::string& text, double fraction);  // shown a few times a second
  // The result of what took long; only on a terminal.
  void done(const std::string& text);

 private:
  struct Log;

  void clear_status();

  std::unique_ptr<Log> log_;
  bool is_terminal_;
  bool has_status_ = false;
  std::chrono::steady_clock::time_point last_progress_;
};

// The time since it was made, in seconds.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace splotchcl::cli
