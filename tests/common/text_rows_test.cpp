#include "text_rows.h"

#include "testing.h"

namespace splotchcl::test {
namespace {

std::vector<TextRow> rows_of(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.rows") << text;
  return read_text_rows(folder / "a.rows");
}

TEST(TextRows, HaveTextsAndWhatIsExpectedOfThem) {
  const std::vector<TextRow> rows = rows_of(
      "## A remark.\nlet end = c\\td\n\n== First\n\na\n\n# b\n-> one\n-> two ${end}\n"
      "\\n\\x61${end}\\\n-or-\nlet it be\n-> three\n\n## Another.\n== Second\nx\\\\\n-> four\n");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].name, "First");
  EXPECT_THAT(rows[0].texts, ElementsAre("a\n\n# b\n"));
  EXPECT_THAT(rows[0].expected, ElementsAre("one", "two c\td"));
  EXPECT_EQ(rows[1].name, "First_2");
  EXPECT_THAT(rows[1].texts, ElementsAre("\nac\td", "let it be\n"));
  EXPECT_EQ(rows[2].name, "Second");
  EXPECT_THAT(rows[2].texts, ElementsAre("x\\\n"));
}

TEST(TextRows, ThatExpectNothingOrAreNoneAreRefused) {
  for (const char* const text :
       {"", "== A\n", "== A\nx\n", "== A\nx\n-or-\n", "== A\n-> x\n", "== A\nx\n== B\ny\n-> z\n",
        "== A\n${none}\n-> x\n", "== A\n\\q\n-> x\n"})
    EXPECT_ANY_THROW(rows_of(text)) << text;
}

}  // namespace
}  // namespace splotchcl::test
