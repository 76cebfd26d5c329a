// Files that become shorter after they were read do not end the process that looks at them.
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/snapshot_writer.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/untrusted_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

class CutFile : public ::testing::Test {
 protected:
  void SetUp() override {
    TestSnapshot written;
    written.counts = {0, 20000, 0, 0, 0, 0};
    add_block(written, "POS", 2U, 3);
    write_gadget(file_, written, 2);
  }
  void cut() const { std::filesystem::resize_file(file_, 10000); }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "snap";
};

TEST_F(CutFile, ReadsAsZerosAndIsTold) {
  const LiveFiles live;
  const auto snapshot = open_snapshot(file_);
  const Column column = snapshot->read(1, "position");
  ASSERT_NE(column[column.size() - 1], 0);
  EXPECT_NO_THROW(live.require_whole());
  cut();
  EXPECT_EQ(column[column.size() - 1], 0);
  EXPECT_NE(column[1], 0);
  EXPECT_THROW(live.require_whole(), DataError);
}

TEST_F(CutFile, IsNoneOfThoseThatComeLater) {
  const LiveFiles before;
  const Column column = open_snapshot(file_)->read(1, "position");
  cut();
  EXPECT_EQ(column[column.size() - 1], 0);
  EXPECT_NO_THROW(LiveFiles().require_whole());
}

TEST_F(CutFile, IsAnErrorWhereItIsReadAnew) {
  const LiveFiles live;
  const auto snapshot = open_snapshot(file_);
  cut();
  EXPECT_THROW((void)snapshot->read(1, "position"), DataError);
}

}  // namespace
}  // namespace splotchcl::test
