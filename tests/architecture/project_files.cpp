#include "architecture/project_files.h"

#include "matches.h"
#include "testing.h"

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
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::vector<std::string> includes;
  for (const Match& found : matches_of(text, "(?:^|\\n)\\s*#\\s*include\\s*\"([^\"]+)\""))
    includes.push_back(found[1]);
  return includes;
}

}  // namespace splotchcl::test
