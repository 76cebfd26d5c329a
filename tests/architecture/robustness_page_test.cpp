// Two pages say by which test each promise is held: those tests exist.
#include "architecture/project_files.h"
#include "matches.h"
#include "testing.h"

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
  // Sessions, and rows of texts: each of them by the name of its file.
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::source_folder() / "tests")) {
    const auto ending = entry.path().extension();
    if (ending != ".session" && ending != ".rows") continue;
    for (const Match& found : matches_of(content_of(entry.path()), R"(\n== (\w+))"))
      tests.insert({entry.path().stem().string(), found[1]});
  }
  return tests;
}

std::set<std::string> tests_of_python() {
  std::set<std::string> tests;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::source_folder() / "tests")) {
    if (entry.path().extension() != ".py") continue;
    for (const Match& found : matches_of(content_of(entry.path()), R"(\bdef (test_\w+)\()"))
      tests.insert(found[1]);
  }
  return tests;
}

constexpr const char* pages_with_tests[] = {"docs/robustness.md", "docs/dev/security.md"};

// `Suite.Name`, `.Name` of the suite before it, `Suite.*` and `*.Name`.
std::vector<TestName> tests_that_are_named(const std::string& page) {
  const std::string text = content_of(test::source_folder() / page);
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
  for (const char* const page : pages_with_tests) {
    const std::vector<TestName> named = tests_that_are_named(page);
    EXPECT_GT(named.size(), 15U);
    for (const TestName& name : named)
      EXPECT_TRUE(is_among(name, tests)) << page << ": " << name.first << "." << name.second;
  }
}

TEST(RobustnessPage, NamesTestsOfPythonThatExist) {
  const std::set<std::string> tests = tests_of_python();
  for (const char* const page : pages_with_tests) {
    const std::string text = content_of(test::source_folder() / page);
    const auto named = matches_of(text, R"(`(test_\w+)`)");
    EXPECT_FALSE(named.empty());
    for (const Match& found : named)
      EXPECT_EQ(tests.count(found[1]), 1U) << page << ": " << found[1];
    for (const Match& found : matches_of(text, R"(`(tests/[\w/]+\.py)`)"))
      EXPECT_TRUE(std::filesystem::exists(test::source_folder() / found[1])) << found[1];
  }
}

}  // namespace
}  // namespace splotchcl::test
