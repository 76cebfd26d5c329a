#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace splotchcl::cli {

// The options that a command was given. They stand for keys of a scene, which its errors name; who
// typed an option looks for its name.
class TypedOptions {
 public:
  TypedOptions() = default;
  explicit TypedOptions(const CLI::App& command);
  explicit TypedOptions(std::map<std::string, std::vector<std::string>> values)
      : values_(std::move(values)) {}

  // An error's message with options in place of keys.
  std::string named_in(const std::string& message) const;

 private:
  bool has(const std::string& option) const { return values_.count(option) > 0; }
  // Whether the option was given this, alone or within more.
  bool has_value(const std::string& option, const std::string& value) const;
  bool is_quoted_in(const std::string& option, const std::string& message) const;
  bool sets(const std::string& key) const;
  std::string option_of(const std::string& key) const;
  std::string without_setting(const std::string& message) const;
  std::string with_option_first(const std::string& message) const;
  std::string with_option_within(const std::string& message) const;
  std::string with_named_place(const std::string& message) const;

  std::map<std::string, std::vector<std::string>> values_;  // by option: --width
};

enum class Verbosity {
  quiet,    // errors only
  normal,   // and notes
  verbose,  // and a line for each thing that is done, with the seconds since the start
};

// What goes to standard error: notes and errors, a line each, and on a terminal a status
// line that is overwritten and finally removed. Off a terminal, where something takes long, a line
// every 30 seconds says what is being done and for how long (or as often as the environment
// variable SPLOTCHCL_PROGRESS_SECONDS says).
class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void set_verbosity(Verbosity verbosity);
  // What errors name in place of keys.
  void set_options(const TypedOptions& options) { options_ = options; }

  void note(const std::string& text);  // splotchcl: note: text
  void note_each_once(const std::vector<std::string>& notes);
  void error(const std::string& text);  // splotchcl: text
  void status(const std::string& text);
  void progress(const std::string& text, double fraction);  // shown a few times a second
  // The result of what took long; only on a terminal, or where verbose.
  void done(const std::string& text);

 private:
  class Reporter;
  struct Log;

  void show_status(const std::string& text);
  void clear_status();
  void tell_now_and_then(const std::string& text);

  std::unique_ptr<Log> log_;
  Verbosity verbosity_ = Verbosity::normal;
  TypedOptions options_;
  bool is_terminal_;
  bool has_status_ = false;
  std::string last_stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_progress_;
  bool has_no_thread_ = false;
  std::unique_ptr<Reporter> reporter_;  // off a terminal, once something is being done
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
