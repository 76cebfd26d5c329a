#include "par/par_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl::par {
ParFile::ParFile(const std::string& text, std::string name_for_messages)
    : name_(std::move(name_for_messages)) {
  const std::string byte_order_mark = "\xEF\xBB\xBF";
  const bool has_mark = text.compare(0, byte_order_mark.size(), byte_order_mark) == 0;
  std::istringstream lines(has_mark ? text.substr(byte_order_mark.size()) : text);
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
  if (!number || !std::isfinite(*number)) refuse(key, "a finite number");
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
  const std::string word = lower_case(value->substr(0, value->find_first_of(" \t")));
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
