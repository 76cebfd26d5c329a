#pragma once

#include <filesystem>
#include <string>

namespace splotchcl::cli {

// Files whose names differ by a number, which a pattern such as turn_%04d.png has a place for.
class NumberedFiles {
 public:
  // Throws UsageError, naming the option, unless there is exactly one %d, %4d or %04d in the
  // file's name.
  NumberedFiles(const std::filesystem::path& pattern, const std::string& option);

  std::filesystem::path at(int number) const;

 private:
  std::filesystem::path folder_;
  std::string before_, after_;
  std::size_t digits_ = 0;
};

// What a process makes of a job that is shared: numbers from first to last - 1.
struct Share {
  int first = 0, last = 0;
};
// `part` is K/N, the K-th of N shares of neighbours, or empty: all. Throws UsageError.
Share share_of(const std::string& part, int count);

}  // namespace splotchcl::cli
