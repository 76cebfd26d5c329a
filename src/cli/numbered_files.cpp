#include "cli/numbered_files.h"

#include <regex>

#include "splotchcl/error.h"

namespace splotchcl::cli {

NumberedFiles::NumberedFiles(const std::filesystem::path& pattern, const std::string& option)
    : folder_(pattern.parent_path()) {
  static const std::regex place("([^%]*)%0?([0-9]?)d([^%]*)");
  const std::string name = pattern.filename().string();
  std::smatch parts;
  if (!std::regex_match(name, parts, place)) {
    throw UsageError(option + ": found '" + pattern.string() +
                     "', expected a name with one place for a number, such as turn_%04d" +
                     pattern.extension().string());
  }
  before_ = parts[1];
  after_ = parts[3];
  if (parts[2].length() > 0) digits_ = static_cast<std::size_t>(std::stoi(parts[2]));
}

std::filesystem::path NumberedFiles::at(int number) const {
  std::string digits = std::to_string(number);
  if (digits.size() < digits_) digits.insert(0, digits_ - digits.size(), '0');
  return folder_ / (before_ + digits + after_);
}

Share share_of(const std::string& part, int count) {
  if (part.empty()) return {0, count};
  static const std::regex fraction("([0-9]{1,6})/([0-9]{1,6})");
  std::smatch numbers;
  const bool good = std::regex_match(part, numbers, fraction);
  const int k = good ? std::stoi(numbers[1]) : 0;
  const int n = good ? std::stoi(numbers[2]) : 0;
  if (k < 1 || k > n) {
    throw UsageError("--part: found '" + part + "', expected K/N with K from 1 to N, such as 2/4");
  }
  const auto border = [&](int i) {
    return static_cast<int>(static_cast<long long>(count) * i / n);
  };
  return {border(k - 1), border(k)};
}

}  // namespace splotchcl::cli
