// docs/original-files.md lists every key and what becomes of it.
#include "par/par_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

TEST(ParDocumentation, NamesEveryKey) {
  const std::string page = test::read_text(test::source_folder() / "docs" / "original-files.md");
  ASSERT_FALSE(page.empty());
  for (const std::string& key : par::translated_keys())
    EXPECT_THAT(page, HasSubstr("`" + key + "`")) << key;
  for (const par::UntranslatedKey& key : par::untranslated_keys())
    EXPECT_THAT(page, HasSubstr("`" + std::string(key.name) + "`")) << key.name;
}

}  // namespace
}  // namespace splotchcl
