#include "cli/numbered_files.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "splotchcl/error.h"

namespace splotchcl::cli {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The whole numbers of K/N; none where it is anything else.
std::optional<std::pair<int, int>> read_fraction(const std::string& text) {
  std::pair<int, int> numbers;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, numbers.first);
  if (error != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [stop, bad] = std::from_chars(slash + 1, end, numbers.second);
  return bad == std::errc() && stop == end ? std::optional(numbers) : std::nullopt;
}

}  // namespace

NumberedFiles::NumberedFiles(const std::filesystem::path& pattern, const std::string& option)
    : folder_(pattern.parent_path()) {
  const std::string name = pattern.filename().string();
  // The place: % and d, between them perhaps a zero and a digit.
  const std::size_t first = name.find('%');
  std::size_t end = std::min(first, name.size() - 1) + 1;
  if (end < name.size() && name[end] == '0') ++end;
  const bool has_digit = end < name.size() && is_digit(name[end]);
  if (has_digit) digits_ = static_cast<std::size_t>(name[end++] - '0');
  const bool is_good = first != std::string::npos && end < name.size() && name[end] == 'd' &&
                       name.find('%', end) == std::string::npos;
  if (!is_good) {
    throw UsageError(option + ": found '" + pattern.string() +
                     "', expected a name with one place for a number, such as turn_%04d" +
                     pattern.extension().string());
  }
  before_ = name.substr(0, first);
  after_ = name.substr(end + 1);
}

std::filesystem::path NumberedFiles::at(int number) const {
  std::string digits = std::to_string(number);
  if (digits.size() < digits_) digits.insert(0, digits_ - digits.size(), '0');
  return folder_ / (before_ + digits + after_);
}

Share share_of(const std::string& part, int count) {
  if (part.empty()) return {0, count};
  const std::pair<int, int> fraction = read_fraction(part).value_or(std::pair(0, 0));
  const int k = fraction.first, n = fraction.second;
  if (k < 1 || k > n) {
    throw UsageError("--part: found '" + part + "', expected K/N with K from 1 to N, such as 2/4");
  }
  const auto border = [&](int i) {
    return static_cast<int>(static_cast<long long>(count) * i / n);
  };
  return {border(k - 1), border(k)};
}

}  // namespace splotchcl::cli
