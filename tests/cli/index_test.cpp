// An index beside a snapshot: never needed, never stale.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

TEST(IndexCommand, ChangesNoPicture) {
  SKIP_WITHOUT_DEVICE();
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 30000").exit_code, 0);
  const std::string draw = "render u --set image.size=[60,40] --set camera.field_of_view=3 -o ";
  ASSERT_EQ(splotchcl_in(folder, draw + "without.exr").exit_code, 0);
  const ProgramResult indexed = splotchcl_in(folder, "index u");
  EXPECT_EQ(indexed.exit_code, 0) << indexed.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "u.splotchcl_index"));
  ASSERT_EQ(splotchcl_in(folder, draw + "with.exr").exit_code, 0);
  EXPECT_EQ(read_text(folder / "without.exr"), read_text(folder / "with.exr"));
}

TEST(IndexCommand, RefusesWhatCannotBeReadInParts) {
  const TemporaryFolder folder;
  std::ofstream(folder / "table.txt") << "# x y z\n1 2 3\n4 5 6\n";
  const ProgramResult result = splotchcl_in(folder, "index table.txt");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot be read in parts"));
}

}  // namespace
}  // namespace splotchcl::test
