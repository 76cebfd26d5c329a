// Tables of text, each with what is read from it or why it is refused.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "formats/snapshot_format.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

std::vector<SnapshotRow> tables() {
  std::vector<SnapshotRow> all;
  for (const char* const file :
       {"headers", "headers_of_programs", "units", "rows_and_numbers", "other_layouts"}) {
    const std::vector<SnapshotRow> rows = snapshot_rows(fmt::format("text/{}.rows", file));
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(TextTable, SnapshotFile, ::testing::ValuesIn(tables()), name_of_row);

TEST(TextTables, InAFolderAreNoSnapshot) {
  const TemporaryFolder folder;
  write_bytes(folder / "table", "x,y,z\n1,2,3\n");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("no snapshot in this folder"));
}

}  // namespace
}  // namespace splotchcl::test
