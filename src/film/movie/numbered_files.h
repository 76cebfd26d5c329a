#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splotchcl {

// The frames that "FIRST:END:STEP" names among those of a film: FIRST, FIRST + STEP, ... before
// END. Each of the three may be left out ("100:", ":200", "::10"); a single number is one
// frame; nothing is all frames. Throws UsageError.
std::vector<int> select_frames(const std::string& text, int frame_count);

// The share of part K of N, given as "K/N", K from 1: neighbouring frames, all parts together
// being all of them. Nothing is all. Throws UsageError.
std::vector<int> select_part(const std::string& text, const std::vector<int>& frames);

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
