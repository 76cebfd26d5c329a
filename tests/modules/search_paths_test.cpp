#include <gtest/gtest.h>

#include <fstream>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

// What the loader is told in an object, "" where it is told nothing: "/usr/lib:$ORIGIN".
std::string search_path(const TemporaryFolder& folder, const std::string& object) {
  const std::string dynamic = run_in(folder, "readelf -d '" + object + "'").out;
  for (const char* const kind : {"RUNPATH", "RPATH"}) {
    const std::size_t line = dynamic.find(std::string("(") + kind + ")");
    if (line == std::string::npos) continue;
    const std::size_t first = dynamic.find('[', line) + 1;
    return dynamic.substr(first, dynamic.find(']', first) - first);
  }
  return "";
}

TEST(SearchPaths, OfAllObjectsHaveAbsoluteEntriesOnly) {
  const TemporaryFolder folder;
  std::ifstream objects(SPLOTCHCL_OBJECTS);
  int count = 0;
  for (std::string object; std::getline(objects, object); ++count) {
    const std::string path = search_path(folder, object);
    if (path.empty()) continue;
    std::istringstream entries(path + ":");
    for (std::string entry; std::getline(entries, entry, ':');) {
      EXPECT_TRUE(entry.rfind('/', 0) == 0 || entry.rfind("$ORIGIN", 0) == 0)
          << object << " has '" << entry << "' in " << path;
    }
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace splotchcl::test
