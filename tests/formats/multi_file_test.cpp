#include "formats/hdf5/hdf5_values.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "formats/numpy/numpy_writer.h"
#include "formats/snapshot_checks.h"
#include "formats/snapshot_writer.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

// The formats that sets come in; 3 is HDF5, as in Gadget's own parameter files.
class MultiFile : public ::testing::TestWithParam<int> {
 protected:
  MultiFile() { std::filesystem::create_directories(folder_ / "set"); }

  std::filesystem::path set_folder() const { return folder_ / "set"; }
  std::filesystem::path base() const { return set_folder() / "snap_007"; }
  std::filesystem::path member(std::size_t i) const {
    return base().string() + "." + std::to_string(i) + (GetParam() < 3 ? "" : ".hdf5");
  }
  void write(const std::filesystem::path& path, const TestSnapshot& snapshot) const {
    GetParam() < 3 ? write_gadget(path, snapshot, GetParam()) : write_hdf5(path, snapshot);
  }
  void write_set(const std::vector<TestSnapshot>& members) const {
    for (std::size_t i = 0; i < members.size(); ++i)
      write(member(i), members[i]);
  }
  // The same particles in one file.
  std::unique_ptr<Snapshot> open_whole() const {
    write(folder_ / "whole", snapshot());
    return open_snapshot(folder_ / "whole");
  }
  TestSnapshot snapshot() const {
    TestSnapshot snapshot = small_snapshot();
    if (GetParam() == 1) snapshot.blocks.resize(7);  // those that format 1 can name
    return snapshot;
  }

  const TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Format, MultiFile, ::testing::Values(1, 2, 3),
                         ::testing::PrintToStringParamName());

TEST_P(MultiFile, ASplitSnapshotReadsAsTheWholeOne) {
  write_set(split(snapshot(), 3));
  const auto joined = open_snapshot(member(0));
  EXPECT_EQ(joined->info().files.size(), 3U);
  expect_same_columns(*joined, *open_whole());
}

TEST_P(MultiFile, ASplitSnapshotOfDoublesHasTheOriginOfTheWholeOne) {
  TestSnapshot written = snapshot();
  written.set_kind("POS", ValueKind::float64);
  write_set(split(written, 3));
  write(folder_ / "doubles", written);
  const auto joined = open_snapshot(member(0));
  const auto whole = open_snapshot(folder_ / "doubles");
  EXPECT_NE(whole->position_origin().a[0], 0);
  EXPECT_EQ(joined->position_origin().a[0], whole->position_origin().a[0]);
  expect_same_columns(*joined, *whole);
}

TEST_P(MultiFile, AnyMemberTheBaseNameAndTheFolderMeanTheSet) {
  write_set(split(snapshot(), 3));
  const auto whole = open_whole();
  for (const auto& path : {member(1), member(2), base(), set_folder()}) {
    const auto joined = open_snapshot(path);
    EXPECT_EQ(joined->info().files,
              (std::vector<std::filesystem::path>{member(0), member(1), member(2)}));
    expect_same_columns(*joined, *whole);
  }
}

TEST_P(MultiFile, MembersWithoutSomeTypesAreJoined) {
  // 37 gas, 20 halo and 11 star particles over 30 files: most have no stars.
  write_set(split(snapshot(), 30));
  expect_same_columns(*open_snapshot(member(0)), *open_whole());
}

TEST_P(MultiFile, MembersOfWhichOneHasAllOfATypeAreReadByAnyNameOfTheSet) {
  TestSnapshot whole = snapshot();
  std::vector<TestSnapshot> members = split(whole, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    members[i].counts[4] = i == 2 ? whole.counts[4] : 0;
    for (TestBlock& block : members[i].blocks)
      block.values[4] = i == 2 ? whole.block(block.label).values[4] : std::vector<double>();
  }
  write_set(members);
  for (const auto& path : {member(0), member(1), member(2), base(), set_folder()}) {
    const auto joined = open_snapshot(path);
    EXPECT_EQ(joined->info().files.size(), 3U) << path;
    expect_columns_of(*joined, whole);
  }
}

TEST_P(MultiFile, AMissingMemberIsNamed) {
  write_set(split(snapshot(), 3));
  std::filesystem::remove(member(1));
  EXPECT_THAT(refusal(member(2)), AllOf(HasSubstr(member(1).string()), HasSubstr("3 files")));
}

TEST_P(MultiFile, ALinkToAMemberStandsForTheSetWhereItPoints) {
  write_set(split(snapshot(), 3));
  for (const char* const name : {"latest", "link.0"}) {
    std::filesystem::create_symlink(member(1), folder_ / name);
    EXPECT_EQ(open_snapshot(folder_ / name)->info().files,
              (std::vector<std::filesystem::path>{member(0), member(1), member(2)}));
  }
}

TEST_P(MultiFile, AMemberUnderAnotherNameIsRefused) {
  write(folder_ / "renamed", split(snapshot(), 3)[0]);
  EXPECT_THAT(refusal(folder_ / "renamed"), HasSubstr("one of 3 files"));
}

TEST_P(MultiFile, AMemberOfAnotherTimeIsRefused) {
  auto members = split(snapshot(), 3);
  members[1].time = 0.75;
  write_set(members);
  EXPECT_THAT(refusal(member(0)), AllOf(HasSubstr(member(1).string()), HasSubstr("another time")));
}

TEST_P(MultiFile, CountsThatDoNotAddUpAreRefused) {
  const auto members = split(snapshot(), 3);
  write_set({members[0], members[1], members[1]});
  EXPECT_THAT(refusal(member(0)), HasSubstr("but their headers say 68"));
}

TEST_P(MultiFile, HighWordsThatTheFilesOwnCountsContradictAreIgnoredWithANote) {
  for (const std::vector<std::uint32_t>& of_first :
       {std::vector<std::uint32_t>{0, 0, 228, 0, 0, 0}, {3, 0, 0, 0, 0, 0}}) {
    auto members = split(snapshot(), 3);
    members[0].high_words = of_first;
    members[1].high_words = {0, 0, 0, 0, 0, 0};
    members[2].high_words = {0, 1, 0, 0, 7, 0};
    write_set(members);
    for (const std::size_t named : {0U, 1U}) {
      const auto joined = open_snapshot(member(named));
      expect_same_columns(*joined, *open_whole());
      EXPECT_THAT(joined->info().notes, Contains(HasSubstr("high words")));
    }
  }
}

TEST_P(MultiFile, HighWordsDoNotExcuseCountsThatDoNotAddUp) {
  auto members = split(snapshot(), 3);
  members[1] = members[2];
  for (TestSnapshot& part : members)
    part.high_words = {0, 0, 228, 0, 0, 0};
  write_set(members);
  EXPECT_THAT(refusal(member(0)), HasSubstr("but their headers say"));
}

TEST_P(MultiFile, ATruncatedMemberIsNamed) {
  write_set(split(snapshot(), 3));
  std::filesystem::resize_file(member(2), std::filesystem::file_size(member(2)) - 7);
  EXPECT_THAT(refusal(member(0)), AllOf(HasSubstr(member(2).string()), HasSubstr("truncated")));
}

TEST_P(MultiFile, AFieldThatAMemberLacksIsLeftOutWithANote) {
  for (const std::size_t without : {0U, 1U}) {
    auto members = split(snapshot(), 2);
    members[without].remove("HSML");
    write_set(members);
    const auto joined = open_snapshot(member(0));
    EXPECT_FALSE(has_field(*joined, 0, "smoothing_length")) << without;
    EXPECT_THAT(joined->info().notes, Contains(HasSubstr("not every file"))) << without;
  }
}

TEST_P(MultiFile, ACompleteFileWhoseHeaderSpeaksOfMoreIsRead) {
  TestSnapshot whole = snapshot();
  whole.files = 424242;
  write(folder_ / "snap", whole);
  const auto opened = open_snapshot(folder_ / "snap");
  EXPECT_EQ(opened->info().files.size(), 1U);
  EXPECT_THAT(opened->info().notes, Contains(HasSubstr("424242 files")));
}

// Each of 68 particles in all, says that it is the only file.
std::vector<TestSnapshot> each_the_only_one(std::vector<TestSnapshot> members) {
  for (TestSnapshot& part : members)
    part.files = 1;
  return members;
}

TEST_P(MultiFile, FilesThatEachSayToBeTheOnlyOneAreReadTogetherWhereTheyAddUp) {
  write_set(each_the_only_one(split(snapshot(), 3)));
  for (const auto& path : {member(0), member(2), base(), set_folder()}) {
    const auto joined = open_snapshot(path);
    expect_same_columns(*joined, *open_whole());
    EXPECT_THAT(joined->info().notes, Contains(HasSubstr("each is the only one")));
  }
}

TEST_P(MultiFile, FilesThatEachSayToBeTheOnlyOneAreRefusedWhereTheyDoNotAddUp) {
  write_set(each_the_only_one(split(snapshot(), 3)));
  std::filesystem::remove(member(2));
  EXPECT_THAT(refusal(member(0)), AllOf(HasSubstr("headers say 68"), HasSubstr("restore the set"),
                                        HasSubstr("a name without a number")));
}

TEST_P(MultiFile, TotalsOfOneFileDoNotHideTheOthersThatItsHeaderSpeaksOf) {
  auto members = split(snapshot(), 2);
  for (TestSnapshot& part : members)
    part.total_counts.assign(part.counts.begin(), part.counts.end());
  write_set(members);
  EXPECT_THAT(refusal(member(0)), AllOf(HasSubstr(member(1).string()), HasSubstr("total number")));
}

TEST_P(MultiFile, FilesOfOtherTimesAreNoPartsOfOneThatCountsTooManyInAll) {
  auto members = each_the_only_one(split(snapshot(), 2));
  members[1].time = 0.75;
  write_set(members);
  EXPECT_EQ(open_snapshot(member(0))->info().files.size(), 1U);
}

TEST(LightCone, OfGadget4IsReadFromAllOfItsFiles) {
  const TemporaryFolder folder;
  for (const std::string name : {"cone.0.hdf5", "cone.1.hdf5"}) {
    const Hdf5Output file = create_hdf5(folder / name);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {0, 2});
    write_attribute(file, "Header", "NumPart_Total", {0, 4});
    write_attribute(file, "Header", "NumFiles", {2});
    write_values(file, "PartType1/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
  }
  EXPECT_EQ(open_snapshot(folder / "cone.1.hdf5")->info().find_type(1)->count, 4U);
  std::filesystem::remove(folder / "cone.0.hdf5");
  EXPECT_THAT(refusal(folder / "cone.1.hdf5"), HasSubstr("cone.0.hdf5: missing"));
}

using SnapshotFolder = FolderTest;

TEST_F(SnapshotFolder, WithSeveralSnapshotsIsRefusedWithTheirNames) {
  write_gadget(folder_ / "snap_001", small_snapshot(), 2);
  write_gadget(folder_ / "snap_002", small_snapshot(), 2);
  write_bytes(folder_ / "notes.txt", "not a snapshot");
  EXPECT_THAT(refusal(folder_.path()),
              AllOf(HasSubstr("2 snapshots"), HasSubstr("snap_001"), HasSubstr("snap_002")));
}

TEST_F(SnapshotFolder, WithoutSnapshotsIsRefused) {
  write_bytes(folder_ / "notes.txt", "not a snapshot");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("no snapshot in this folder"));
}

void write_map(const std::filesystem::path& path) {
  const Hdf5Output file = create_hdf5(path);
  write_values(file, "map", {1, 2, 3, 4}, 2);
  write_text(file, "map", "quantity", "surface density");
  write_text(file, "map", "unit", "Msun/pc^2");
  write_attribute(file, "map", "extent", {0, 1, 0, 1});
}

TEST_F(SnapshotFolder, MayHoldMapsBesideItsSnapshot) {
  write_map(folder_ / "sigma.hdf5");
  write_bytes(folder_ / "sigma.npy",
              numpy_bytes(numpy_header("<f4", "(2, 64)"), bytes_of(std::vector<float>(128, 1))));
  write_bytes(folder_ / "with_noise.npy",
              numpy_bytes(numpy_header("<f4", "(2, 3, 3)"), bytes_of(std::vector<float>(18, 1))));
  write_gadget(folder_ / "snap_001", small_snapshot(), 2);
  EXPECT_EQ(open_snapshot(folder_.path())->info().files.front(), folder_ / "snap_001");
}

TEST_F(SnapshotFolder, MayHoldLinksThatLeadNowhere) {
  write_gadget(folder_ / "snap_001", small_snapshot(), 2);
  std::filesystem::create_symlink("loop", folder_ / "loop");
  std::filesystem::create_symlink("gone", folder_ / "old");
  EXPECT_EQ(open_snapshot(folder_.path())->info().files.front(), folder_ / "snap_001");
}

TEST_F(SnapshotFolder, OfAMapAloneIsRefusedForWhatItHolds) {
  write_map(folder_ / "sigma.hdf5");
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("sigma.hdf5: holds a map"));
}

TEST_F(SnapshotFolder, SurplusMembersAreNotSilentlyDropped) {
  write_gadget_set(folder_ / "snap", split(small_snapshot(), 2), 2);
  write_gadget(folder_ / "snap.2", small_snapshot(), 2);
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("holds 3 files"));
}

TEST(SnapshotName, TheEndingMayBeLeftOut) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap_001.hdf5", small_snapshot());
  EXPECT_EQ(open_snapshot(folder / "snap_001")->info().files.front(), folder / "snap_001.hdf5");
}

TEST(SnapshotName, ABaseNameWithTwoMeaningsIsRefused) {
  const TemporaryFolder folder;
  write_hdf5(folder / "snap_001.hdf5", small_snapshot());
  write_gadget_set(folder / "snap_001", split(small_snapshot(), 2), 2);
  EXPECT_THAT(refusal(folder / "snap_001"),
              AllOf(HasSubstr("could be snap_001.hdf5 or snap_001.0")));
}

TEST(SnapshotName, AMissingFileIsNamed) {
  EXPECT_THAT(refusal("no/such/snapshot"), HasSubstr("no/such/snapshot: no such file"));
}

TEST(SnapshotName, TheNameDoesNotDecideTheFormat) {
  const TemporaryFolder folder;
  write_gadget(folder / "snap.hdf5", small_snapshot(), 2);
  EXPECT_THAT(open_snapshot(folder / "snap.hdf5")->info().format, HasSubstr("Gadget format 2"));
}

}  // namespace
}  // namespace splotchcl::test
