// Tables of text, each with what is read from it or why it is refused.
#include "formats/snapshot_format.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

INSTANTIATE_TEST_SUITE_P(TextTable, SnapshotFile,
                         ::testing::ValuesIn(snapshot_rows("text/tables.rows")), name_of_row);

TEST(TextTables, InAFolderAreNoSnapshot) {
  const TemporaryFolder folder;
  write_bytes(folder / "table", "x,y,z\n1,2,3\n");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("no snapshot in this folder"));
}

}  // namespace
}  // namespace splotchcl::test
