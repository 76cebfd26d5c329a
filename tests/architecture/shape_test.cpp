// How branched the kernels are, as scripts/measure_shape counts it. Lower the numbers when they
// fall; what raises them has to be worth it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "matches.h"
#include "paths.h"

namespace splotchcl::test {
namespace {

// What each #if, #ifdef, #ifndef and #elif of the kernels asks for.
std::vector<std::string> conditions_of_kernels() {
  std::vector<std::string> conditions;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_folder() / "kernels")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      for (const Match& match : matches_of(line, R"(^\s*#\s*(?:if|ifdef|ifndef|elif)\b(.*))"))
        conditions.push_back(match[1]);
    }
  }
  return conditions;
}

std::set<std::string> macros_of(const std::vector<std::string>& conditions) {
  std::set<std::string> macros;
  for (const std::string& condition : conditions) {
    for (const Match& match : matches_of(condition, R"(\b([A-Z_]\w+)\b)")) {
      const std::string name = match[1];
      if (name.rfind("__", 0) != 0 && name.rfind("SPLOTCHCL_", 0) != 0) macros.insert(name);
    }
  }
  return macros;
}

TEST(Shape, KernelsAreNoMoreBranchedThanTheyWere) {
  const std::vector<std::string> conditions = conditions_of_kernels();
  EXPECT_GT(conditions.size(), 100u);  // they were found
  EXPECT_LE(conditions.size(), 477u);
  EXPECT_LE(macros_of(conditions).size(), 62u);
}

}  // namespace
}  // namespace splotchcl::test
