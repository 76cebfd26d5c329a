// Ids are read exactly: single precision, as other fields have it, would mix up particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using namespace splotchcl::test;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

constexpr std::uint64_t beyond_doubles = (std::uint64_t{1} << 53) - 1;

// Neighbouring numbers that single precision cannot tell apart.
TestSnapshot snapshot_with_large_ids() {
  TestSnapshot snapshot = small_snapshot();
  snapshot.set_kind("ID", ValueKind::uint64);
  for (std::vector<double>& ids : snapshot.block("ID").values) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = static_cast<double>(beyond_doubles - i);
  }
  return snapshot;
}

std::vector<std::uint64_t> counted_down(std::size_t count) {
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < count; ++i)
    ids.push_back(beyond_doubles - i);
  return ids;
}

TEST(Ids, AreExactIn64BitsInEveryFormatAndEndianness) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = snapshot_with_large_ids();
  write_gadget(folder / "one", snapshot, 1);
  write_gadget(folder / "two", snapshot, 2);
  write_gadget(folder / "swapped", snapshot, 2, true);
  write_hdf5(folder / "snapshot.hdf5", snapshot);
  for (const char* const name : {"one", "two", "swapped", "snapshot.hdf5"}) {
    SCOPED_TRACE(name);
    const auto opened = open_snapshot(folder / name);
    EXPECT_THAT(opened->read_ids(0), ElementsAreArray(counted_down(snapshot.counts[0])));
    EXPECT_THAT(opened->read_ids(4), ElementsAreArray(counted_down(snapshot.counts[4])));
  }
}

TEST(Ids, OfSeveralFilesFollowEachOther) {
  const TemporaryFolder folder;
  const TestSnapshot snapshot = snapshot_with_large_ids();
  write_gadget_set(folder / "set", split(snapshot, 3), 2);
  EXPECT_THAT(open_snapshot(folder / "set")->read_ids(1),
              ElementsAreArray(counted_down(snapshot.counts[1])));
}

TEST(Ids, ThatAreNotThereAreRefused) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.remove("ID");
  write_gadget(folder / "snap", snapshot, 2);
  const auto opened = open_snapshot(folder / "snap");
  try {
    opened->read_ids(0);
    FAIL() << "read ids that are not there";
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), HasSubstr("particles of type 0 have no ids"));
  }
}

TEST(Ids, ThatAreNotWholeNumbersAreRefused) {
  const TemporaryFolder folder;
  TestSnapshot snapshot = small_snapshot();
  snapshot.set_kind("ID", ValueKind::float32);
  write_hdf5(folder / "snap.hdf5", snapshot);
  EXPECT_THROW(open_snapshot(folder / "snap.hdf5")->read_ids(0), DataError);
}

}  // namespace
}  // namespace splotchcl
