#include "cli/console.h"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace splotchcl::cli {
namespace {

// Notes and errors are a line each, whatever a library put into them.
std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(std::move(text));
}

}  // namespace

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 32 || c == '\x7f'; }, '?');
  return text;
}

struct Console::Log {
  spdlog::logger logger{"splotchcl", std::make_shared<spdlog::sinks::stderr_sink_st>()};
};

Console::Console() : log_(std::make_unique<Log>()), is_terminal_(::isatty(STDERR_FILENO) == 1) {
  log_->logger.set_pattern("splotchcl: %v");
}

Console::~Console() {
  clear_status();
}

void Console::note(const std::string& text) {
  clear_status();
  log_->logger.warn("note: {}", one_line(text));
}

void Console::error(const std::string& text) {
  clear_status();
  log_->logger.error("{}", one_line(text));
}

void Console::status(const std::string& text) {
  if (!is_terminal_) return;
  // Back to the start of the line, and erase it.
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  has_status_ = true;
}

void Console::progress(const std::string& text, double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_progress_ < std::chrono::milliseconds(200)) return;
  last_progress_ = now;
  status(text + " " + std::to_string(std::lround(100 * fraction)) + " %");
}

void Console::done(const std::string& text) {
  if (!is_terminal_) return;
  status(text);
  std::fputc('\n', stderr);
  has_status_ = false;
}

void Console::clear_status() {
  if (!has_status_) return;
  std::fputs("\r\033[K", stderr);
  has_status_ = false;
}

}  // namespace splotchcl::cli
