#include "film/movie/numbered_files.h"

#include <fmt/printf.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Whether a number stands at the place of the '%'.
bool is_number(const std::string& name, std::size_t percent) {
  constexpr std::size_t most_digits = 3;
  std::size_t end = percent + 1;
  while (end < name.size() && end - percent <= most_digits &&
         std::isdigit(static_cast<unsigned char>(name[end])) != 0) {
    ++end;
  }
  return end < name.size() && name[end] == 'd';
}

}  // namespace

std::optional<NumberedFiles> NumberedFiles::find(const std::filesystem::path& pattern) {
  const std::string name = pattern.filename().string();
  const bool has_one = std::count(name.begin(), name.end(), '%') == 1;
  if (!has_one || !is_number(name, name.find('%'))) return std::nullopt;
  return NumberedFiles(pattern);
}

NumberedFiles NumberedFiles::require(const std::filesystem::path& pattern,
                                     const std::string& option) {
  if (std::optional<NumberedFiles> files = find(pattern)) return *files;
  throw UsageError(option + ": found '" + pattern.string() +
                   "', expected a name with one place for a number, such as turn_%04d" +
                   pattern.extension().string());
}

std::filesystem::path NumberedFiles::at(int number) const {
  return pattern_.parent_path() / fmt::sprintf(pattern_.filename().string(), number);
}

}  // namespace splotchcl
