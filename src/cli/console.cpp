#include "cli/console.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "common/quiet_errors.h"
#include "common/utf8.h"

namespace splotchcl::cli {
namespace {

using Clock = std::chrono::steady_clock;

// Notes and errors are a line each, whatever a library put into them.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 4000;  // a name in a file may have millions of letters
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text);
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// How often a pipe or a file hears what is being done. Anything but a number above 0 is ignored.
std::chrono::duration<double> reporting_interval() {
  constexpr double usual = 30;
  const char* const text = std::getenv("SPLOTCHCL_PROGRESS_SECONDS");
  const double seconds = text == nullptr ? usual : std::strtod(text, nullptr);
  return std::chrono::duration<double>(seconds > 0 && seconds < 1e6 ? seconds : usual);
}

}  // namespace

// Where libraries cannot be heard while they work, the program can.
using ErrorSink = spdlog::sinks::stdout_sink_base<spdlog::details::console_mutex>;

struct Console::Log {
  spdlog::logger logger{"splotchcl", std::make_shared<ErrorSink>(error_stream())};
};

// Tells from time to time what is being done, also while nothing calls the console.
class Console::Reporter {
 public:
  explicit Reporter(spdlog::logger& logger)
      : logger_(logger), thread_([this] { report_until_ended(); }) {}
  ~Reporter() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      has_ended_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

  void set(const std::string& what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    what_ = what;
  }

 private:
  void report_until_ended() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!changed_.wait_for(lock, interval_, [this] { return has_ended_; })) {
      logger_.info("{:.0f} s: {}", seconds_since(start_), one_line(what_));
    }
  }

  spdlog::logger& logger_;
  const std::chrono::duration<double> interval_ = reporting_interval();
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string what_;
  bool has_ended_ = false;
  std::thread thread_;  // last: it uses the others
};

Console::Console() : log_(std::make_unique<Log>()), is_terminal_(::isatty(STDERR_FILENO) == 1) {
  log_->logger.set_pattern("splotchcl: %v");
}

Console::~Console() {
  reporter_.reset();
  clear_status();
}

void Console::set_verbosity(Verbosity verbosity) {
  verbosity_ = verbosity;
}

void Console::note(const std::string& text) {
  if (verbosity_ == Verbosity::quiet) return;
  clear_status();
  log_->logger.warn("note: {}", one_line(text));
}

void Console::note_each_once(const std::vector<std::string>& notes) {
  std::set<std::string> told;
  for (const std::string& text : notes) {
    if (told.insert(text).second) note(text);
  }
}

void Console::error(const std::string& text) {
  reporter_.reset();
  clear_status();
  log_->logger.error("{}", one_line(options_.named_in(text)));
}

void Console::status(const std::string& text) {
  if (verbosity_ == Verbosity::quiet) return;
  if (verbosity_ == Verbosity::verbose && text != last_stage_) {
    clear_status();
    log_->logger.info("{:.2f} s: {}", seconds_since(start_), one_line(text));
    last_stage_ = text;
  }
  show_status(text);
}

void Console::progress(const std::string& text, double fraction) {
  if (verbosity_ == Verbosity::quiet) return;
  const auto now = Clock::now();
  if (now - last_progress_ < std::chrono::milliseconds(200)) return;
  last_progress_ = now;
  show_status(fmt::format("{} {} %", text, std::lround(100 * fraction)));
}

void Console::show_status(const std::string& text) {
  if (!is_terminal_) {
    tell_now_and_then(text);
    return;
  }
  // Back to the start of the line, and erase it.
  std::fprintf(error_stream(), "\r\033[K%s", one_line(text).c_str());
  std::fflush(error_stream());
  has_status_ = true;
}

void Console::tell_now_and_then(const std::string& text) {
  if (!reporter_ && !has_no_thread_) {
    try {
      reporter_ = std::make_unique<Reporter>(log_->logger);
    } catch (const std::system_error&) {
      has_no_thread_ = true;  // nothing that is done needs the report
    }
  }
  if (reporter_) reporter_->set(text);
}

void Console::done(const std::string& text) {
  if (verbosity_ == Verbosity::quiet) return;
  reporter_.reset();
  clear_status();
  if (is_terminal_) {
    std::fprintf(error_stream(), "%s\n", one_line(text).c_str());
  } else if (verbosity_ == Verbosity::verbose) {
    log_->logger.info("{:.2f} s: {}", seconds_since(start_), one_line(text));
  }
}

void Console::clear_status() {
  if (!has_status_) return;
  std::fputs("\r\033[K", error_stream());
  has_status_ = false;
}

}  // namespace splotchcl::cli
