#include "common/shrink_guard.h"
#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::HasSubstr;

TestSnapshot long_snapshot() {
  TestSnapshot written;
  written.counts = {0, 20000, 0, 0, 0, 0};
  add_block(written, "POS", 2U, 3);
  add_block(written, "ID", 2U, 1);
  written.set_kind("ID", ValueKind::uint32);
  return written;
}

TEST(ShrinkingFiles, AreRefusedWhenTheNextFieldIsRead) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  std::filesystem::resize_file(folder / "snap", 5000);
  EXPECT_THAT([&] { snapshot->read(1, "position"); },
              ::testing::ThrowsMessage<DataError>(
                  HasSubstr("became shorter while it was read: found 5000 bytes, expected")));
  EXPECT_THROW(snapshot->read_ids(1), DataError);
}

TEST(ShrinkingFiles, ThatAreReplacedStayAsTheyWere) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  const auto snapshot = open_snapshot(folder / "snap");
  write_bytes(folder / "new", "short");
  std::filesystem::rename(folder / "new", folder / "snap");
  EXPECT_EQ(snapshot->read(1, "position").size(), 60000U);
}

void read_what_is_gone(const std::filesystem::path& path) {
  guard_mapped_files();
  const Column positions = open_snapshot(path)->read(1, "position");
  std::filesystem::resize_file(path, 5000);
  volatile float last = positions[positions.size() - 1];
  static_cast<void>(last);
}

TEST(ShrinkingFilesDeathTest, EndTheProgramWithAMessageWhenTheyAreInUse) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap", long_snapshot(), 2);
  EXPECT_EXIT(read_what_is_gone(folder / "snap"), ::testing::ExitedWithCode(1),
              "snap: became shorter while it was read: found 5000 bytes, expected [0-9]+; wait");
}

}  // namespace
}  // namespace splotchcl
