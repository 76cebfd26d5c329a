#include "io/par/par_file.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "splotchcl/error.h"

namespace splotchcl::par {
namespace {

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const char* first = text.data();
  const char* const last = first + text.size();
  if (first != last && *first == '+') ++first;
  const auto [end, error] = fast_float::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

ParFile::ParFile(const std::string& text, std::string name_for_messages)
    : name_(std::move(name_for_messages)) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    add(trimmed(line.substr(0, line.find('#'))), number);
}

void ParFile::add(const std::string& line, int number) {
  if (line.empty()) return;
  const std::size_t equals = line.find('=');
  // Remarks in brackets or dashes stood in some files without a mark.
  const std::string key = equals == std::string::npos ? "" : trimmed(line.substr(0, equals));
  if (key.empty() || key.find_first_of(" \t") != std::string::npos) {
    throw UsageError(fmt::format("{}:{}: found \"{}\", expected key=value, or # before a remark",
                                 name_, number, line));
  }
  // What follows a blank after a value is a remark in the original's own files.
  const Entry entry = {trimmed(line.substr(equals + 1)), number};
  const auto [place, is_new] = entries_.insert_or_assign(key, entry);
  if (!is_new) {
    notes_.push_back(
        fmt::format("{}:{}: {} is given again; the last value counts", name_, number, key));
  }
}

std::optional<std::string> ParFile::text(const std::string& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return std::nullopt;
  used_.insert(key);
  if (found->second.value.empty()) return std::nullopt;
  return found->second.value;
}

std::optional<double> ParFile::number(const std::string& key) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  // "30   (default: 4)": a remark without its mark.
  const auto number = parse_number(value->substr(0, value->find_first_of(" \t")));
  if (!number) refuse(key, "a finite number");
  return number;
}

std::optional<int> ParFile::integer(const std::string& key, int lowest, int highest) {
  const auto value = number(key);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value) || *value < lowest || *value > highest) {
    refuse(key, fmt::format("a whole number from {} to {}", lowest, highest));
  }
  return static_cast<int>(*value);
}

std::optional<bool> ParFile::boolean(const std::string& key) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  std::string word = value->substr(0, value->find_first_of(" \t"));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (word == "t" || word == "true" || word == "1") return true;
  if (word == "f" || word == "false" || word == "0") return false;
  refuse(key, "T or F");
}

void ParFile::refuse(const std::string& key, const std::string& expected) const {
  const auto found = entries_.find(key);
  if (found == entries_.end()) {
    throw UsageError(fmt::format("{}: key {}: found nothing, expected {}", name_, key, expected));
  }
  throw UsageError(fmt::format("{}:{}: key {}: found \"{}\", expected {}", name_,
                               found->second.line, key, found->second.value, expected));
}

std::vector<std::string> ParFile::unused() const {
  std::vector<std::string> keys;
  for (const auto& [key, entry] : entries_) {
    if (used_.count(key) == 0) keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end(), [this](const std::string& a, const std::string& b) {
    return entries_.at(a).line < entries_.at(b).line;
  });
  return keys;
}

}  // namespace splotchcl::par
