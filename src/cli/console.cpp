#include "cli/console.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "cli/scene_options.h"
#include "common/guards.h"
#include "common/words.h"

namespace splotchcl::cli {
namespace {

struct KeyOfOption {
  std::string key, option;
};

// All but those of map_options().
const std::vector<KeyOfOption>& common_keys() {
  static const std::vector<KeyOfOption> keys = {
      {"types", "--types"},
      {"where", "--where"},
      {"field", "--field"},
      {"palette", "--palette"},
      {"center", "--center"},
      {"width", "--width"},
      {"option --where", "--where"},
      {"option --center", "--center"},
      {"option --width", "--width"},
      {"option --depth", "--depth"},
      {"image.size", "--size"},
      {"look", "--look"},
      {"tolerance", "--tolerance"},
      {"read.every", "--every"},
      {"read.max_particles", "--max-particles"},
      {"read.columns", "--columns"},
      {"read.skip_lines", "--skip-lines"},
      {"select.where", "--where"},
      {"color.field", "--field"},
      {"map.quantity", "--field"},
      {"map.palette", "--palette"},
      {"map.center", "--center"},
      {"map.center_at", "--center"},
      {"map.width", "--width"},
      {"map.contour_count", "--contours"},
      {"particles", "--particles"},
      {"stars", "--stars"},
  };
  return keys;
}

std::vector<KeyOfOption> keys_of_options() {
  std::vector<KeyOfOption> keys = common_keys();
  for (const MapOption& option : map_options())
    keys.push_back({"map." + option.key, "--" + option.name});
  return keys;
}

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

// component.0.types and component.gas.types are types.
std::string without_component(const std::string& key) {
  const bool is_of_component = begins_with(key, "component.");
  const std::string ending = ".types";
  const bool is_types =
      key.size() > ending.size() && key.rfind(ending) == key.size() - ending.size();
  return is_of_component && is_types ? "types" : key;
}

}  // namespace

TypedOptions::TypedOptions(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    for (const std::string& name : option->get_lnames())
      values_["--" + name] = option->results();
  }
}

bool TypedOptions::has_value(const std::string& option, const std::string& value) const {
  const auto found = values_.find(option);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(), [&](const std::string& text) {
           return text.find(value) != std::string::npos;
         });
}

// By --set.
bool TypedOptions::sets(const std::string& key) const {
  const auto found = values_.find("--set");
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(),
                     [&](const std::string& setting) { return begins_with(setting, key + "="); });
}

// Empty where no option that was typed stands for the key.
std::string TypedOptions::option_of(const std::string& key) const {
  if (sets(key)) return {};
  const std::string name = without_component(key);
  for (const auto& [of, option] : keys_of_options()) {
    if (of == name && has(option)) return option;
  }
  return {};
}

// Of 'setting "map.width=-3": key map.width: found' what follows the setting, if an option made it.
std::string TypedOptions::without_setting(const std::string& message) const {
  const std::string start = "setting \"";
  if (!begins_with(message, start)) return message;
  const std::string key = message.substr(start.size(), message.find('=') - start.size());
  const std::size_t end = message.find("\": key " + key + ": ");
  if (option_of(key).empty() || end == std::string::npos) return message;
  return message.substr(end + 3);
}

// Of "key map.width: found" and "width: found".
std::string TypedOptions::with_option_first(const std::string& message) const {
  const std::string word = "key ";
  const std::size_t begin = begins_with(message, word) ? word.size() : 0;
  const std::size_t end = message.find(": ");
  if (end == std::string::npos || end < begin) return message;
  const std::string key = message.substr(begin, end - begin);
  std::string option = option_of(key);
  // Who has given no width may do so by the option.
  const bool is_missing = key == "map.width" && message.find("found") == std::string::npos;
  if (option.empty() && is_missing) option = "--width";
  return option.empty() ? message : option + message.substr(end);
}

// Of 'component gas: color.field is "u", which' and 'component gas: select.where: found', where it
// is about what was typed.
std::string TypedOptions::with_option_within(const std::string& message) const {
  for (const auto& [key, option] : keys_of_options()) {
    for (const std::string& end : {std::string(" is \""), std::string(": ")}) {
      const std::string words = std::string(" ") + key + end;
      const std::size_t place = message.find(words);
      if (place == std::string::npos) continue;
      const std::size_t rest = place + words.size();
      const bool is_typed =
          end == ": " ? is_quoted_in(option, message.substr(rest))
                      : has_value(option, message.substr(rest, message.find('"', rest) - rest));
      if (is_typed)
        return message.substr(0, place + 1) + option + message.substr(rest - end.size());
    }
  }
  return message;
}

// Whether the message quotes what the option was given.
bool TypedOptions::is_quoted_in(const std::string& option, const std::string& message) const {
  const auto found = values_.find(option);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(), [&](const std::string& text) {
           return message.find('"' + text + '"') != std::string::npos;
         });
}

// Of "component with select.halo 3: particles", where --center halo=3 asks for the place.
std::string TypedOptions::with_named_place(const std::string& message) const {
  const std::string start = "component with select.halo ";
  if (!begins_with(message, start)) return message;
  const std::size_t end = message.find(':');
  const std::string words = "halo=" + message.substr(start.size(), end - start.size());
  for (const char* option : {"--center", "--follow", "--dive"}) {
    if (has_value(option, words)) return std::string(option) + " " + words + message.substr(end);
  }
  return message;
}

std::string TypedOptions::named_in(const std::string& message) const {
  return with_named_place(with_option_within(with_option_first(without_setting(message))));
}

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
  Reporter(spdlog::logger& logger, std::string what)
      : logger_(logger), what_(std::move(what)), thread_([this] { report_until_ended(); }) {}
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
      reporter_ = std::make_unique<Reporter>(log_->logger, text);
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
