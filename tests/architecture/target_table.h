#pragma once

#include <filesystem>
#include <istream>
#include <set>
#include <string>
#include <vector>

namespace splotchcl::test {

// A library or program as CMake has it (cmake/target_table.cmake).
struct Target {
  std::string name;
  std::vector<std::filesystem::path> folders;  // of the project; the innermost one counts
  std::vector<std::string> public_headers;     // as they are included
  std::vector<std::string> links;              // targets
  std::vector<std::string> exports;            // targets that come with it for who links it
};

class TargetTable {
 public:
  explicit TargetTable(std::vector<Target> targets) : targets_(std::move(targets)) {}
  // Throws std::runtime_error for a line that is none of a table.
  static TargetTable read(std::istream& text);

  const std::vector<Target>& targets() const { return targets_; }
  // Null where there is none.
  const Target* find(const std::string& name) const;
  const Target* owner_of_header(const std::string& public_header) const;
  // Of a file of the project.
  const Target* owner_of_file(const std::filesystem::path& file) const;

  // What a target may include: itself, what it links, and what comes with that.
  std::set<std::string> may_include(const Target& target) const;

 private:
  void add_with_exports(const std::string& name, std::set<std::string>& names) const;

  std::vector<Target> targets_;
};

}  // namespace splotchcl::test
