#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace splotchcl {

// Files whose names differ by a number, which a pattern such as turn_%04d.png has a place for:
// exactly one %d, or with a width as printf knows it, %4d or %04d, in the file's name.
class NumberedFiles {
 public:
  // Nothing for a name that is no such pattern.
  static std::optional<NumberedFiles> find(const std::filesystem::path& pattern);
  // Throws UsageError, naming the option, for such a name.
  static NumberedFiles require(const std::filesystem::path& pattern, const std::string& option);

  std::filesystem::path at(int number) const;

 private:
  explicit NumberedFiles(std::filesystem::path pattern) : pattern_(std::move(pattern)) {}

  std::filesystem::path pattern_;
};

}  // namespace splotchcl
