#include "formats/snapshot_checks.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Xyz : public ::testing::Test {
 protected:
  std::unique_ptr<Snapshot> open(const std::string& text) const {
    write_bytes(path_, text);
    return open_snapshot(path_);
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "points.xyz";
};

TEST_F(Xyz, ElementsAreLeftOutAndPositionsRead) {
  const auto snapshot = open("2\nmade on a day\nH 1 2 3\nHe 4 5 6\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("do not hold numbers: element")));
}

TEST_F(Xyz, TheLineOfTextMayBeEmpty) {
  EXPECT_THAT(absolute_positions(*open("2\n\n1 2 3\n4 5 6\n"), 0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(Xyz, TheLineOfTextMayTellWhatTheColumnsAre) {
  const auto snapshot = open(
      "2\nLattice=\"10 0 0 0 20 0 0 0 30\" Properties=species:S:1:pos:R:3:mass:R:1 Time=0.5\n"
      "H 1 2 3 7\nH 4 5 6 8\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(7, 8));
  EXPECT_EQ(snapshot->info().time, 0.5);
  ASSERT_TRUE(snapshot->info().box_size);
  EXPECT_EQ((*snapshot->info().box_size)[1], 20);
}

TEST_F(Xyz, ABoxThatLeansOrIsNotPeriodicIsNone) {
  EXPECT_FALSE(
      open("2\nLattice=\"1 0 0 1 1 0 0 0 1\" Properties=pos:R:3\n1 2 3\n4 5 6\n")->info().box_size);
  EXPECT_FALSE(
      open("2\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T T F\" Properties=pos:R:3\n1 2 3\n4 5 6\n")
          ->info()
          .box_size);
}

TEST_F(Xyz, NamesBelowANumberAreThoseOfColumns) {
  EXPECT_THAT(absolute_positions(*open("2\ny x z\n1 2 3\n4 5 6\n"), 0),
              ElementsAre(2, 1, 3, 5, 4, 6));
}

TEST_F(Xyz, RowsBelowANumberAreNoText) {
  write_bytes(path_, "2\n1 2 3\n4 5 6\n");
  EXPECT_THAT(absolute_positions(*open_snapshot(path_, {{"z", "y", "x"}}), 0),
              ElementsAre(3, 2, 1, 6, 5, 4));
  write_bytes(path_, "no table\nat all\n");
  EXPECT_THAT(
      [&] {
        open_snapshot(path_, {{"z", "y", "x"}});
      },
      ::testing::ThrowsMessage<DataError>(HasSubstr("found no row of 3 columns")));
}

TEST_F(Xyz, OfSeveralTablesTheLastIsRead) {
  const auto snapshot = open("1\nfirst\nH 1 2 3\n2\nsecond\nH 4 5 6\nH 7 8 9\n");
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(4, 5, 6, 7, 8, 9));
  EXPECT_THAT(snapshot->info().notes, Contains(HasSubstr("2 tables one after the other")));
}

TEST_F(Xyz, OtherNumbersOfRowsThanItSaysAreRefused) {
  EXPECT_THAT([&] { open("3\ntext\nH 1 2 3\nH 4 5 6\n"); },
              ::testing::ThrowsMessage<DataError>(HasSubstr("found 2 rows, expected 3")));
}

}  // namespace
}  // namespace splotchcl::test
