// docs/original-files.md lists every key and what becomes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "par/par_file.h"
#include "paths.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using ::testing::HasSubstr;

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
