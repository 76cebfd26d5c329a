#include "architecture/project_files.h"

#include <algorithm>
#include <fstream>
#include <regex>

namespace splotchcl::test {

namespace fs = std::filesystem;

std::vector<fs::path> source_files(const fs::path& root, const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(root / folder)) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const fs::path ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") files.push_back(fs::relative(entry.path(), root));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> quoted_includes(const fs::path& file) {
  static const std::regex include("^\\s*#\\s*include\\s*\"([^\"]+)\"");
  std::vector<std::string> includes;
  std::ifstream text(file);
  std::smatch match;
  for (std::string line; std::getline(text, line);) {
    if (std::regex_search(line, match, include)) includes.push_back(match[1]);
  }
  return includes;
}

}  // namespace splotchcl::test
