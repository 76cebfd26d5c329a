// docs/robustness.md says by which test each promise is held: those tests exist.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "architecture/project_files.h"
#include "matches.h"
#include "paths.h"

namespace splotchcl::test {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Suite and name.
using TestName = std::pair<std::string, std::string>;

std::set<TestName> tests_of_the_project() {
  std::set<TestName> tests;
  const std::string definition = R"(\bTEST(?:_F|_P)?\((\w+),\s*(\w+)\))";
  for (const auto& path : source_files(test::source_folder(), "tests")) {
    for (const Match& found : matches_of(content_of(test::source_folder() / path), definition))
      tests.insert({found[1], found[2]});
  }
  return tests;
}

// `Suite.Name`, `.Name` of the suite before it, `Suite.*` and `*.Name`.
std::vector<TestName> tests_that_are_named() {
  const std::string text = content_of(test::source_folder() / "docs/robustness.md");
  std::vector<TestName> named;
  std::string suite;
  for (const Match& found : matches_of(text, R"(`(\w*|\*)\.([A-Z]\w+|\*)`)")) {
    if (!found[1].empty()) suite = found[1];
    named.push_back({suite, found[2]});
  }
  return named;
}

bool is_among(const TestName& named, const std::set<TestName>& tests) {
  const auto fits = [](const std::string& asked, const std::string& name) {
    return asked == "*" || asked == name;
  };
  for (const TestName& one : tests)
    if (fits(named.first, one.first) && fits(named.second, one.second)) return true;
  return false;
}

TEST(RobustnessPage, NamesTestsThatExist) {
  const std::set<TestName> tests = tests_of_the_project();
  const std::vector<TestName> named = tests_that_are_named();
  EXPECT_GT(named.size(), 50U);
  for (const TestName& name : named)
    EXPECT_TRUE(is_among(name, tests)) << name.first << "." << name.second;
}

}  // namespace
}  // namespace splotchcl::test
