// The files of the page are in the program.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "matches.h"
#include "view/requests/page_requests.h"

namespace splotchcl::view {
namespace {

TEST(PageFiles, ThePageItselfHasNoName) {
  const auto page = find_page_file("");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->type, "text/html; charset=utf-8");
  EXPECT_EQ(page->text.substr(0, 9), "<!doctype");
}

TEST(PageFiles, HaveTheirTypes) {
  EXPECT_EQ(find_page_file("style.css")->type, "text/css; charset=utf-8");
  EXPECT_EQ(find_page_file("app.js")->type, "text/javascript; charset=utf-8");
}

TEST(PageFiles, NoOthersAreServed) {
  for (const char* const name : {"../CMakeLists.txt", "/etc/passwd", "app", ".", "App.js"})
    EXPECT_FALSE(find_page_file(name)) << name;
}

TEST(PageFiles, ScriptsImportOnlyThoseThatAreThere) {
  const std::string script(find_page_file("app.js")->text);
  const std::vector<test::Match> imports = test::matches_of(script, "from '\\./([a-z_.]+)'");
  for (const test::Match& import : imports)
    EXPECT_TRUE(find_page_file(import[1])) << import[1];
  EXPECT_GT(imports.size(), 3U);
}

}  // namespace
}  // namespace splotchcl::view
