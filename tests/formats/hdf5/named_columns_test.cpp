#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class NamedColumns : public ::testing::Test {
 protected:
  NamedColumns() {
    const Hdf5Output file = create_hdf5(path_);
    write_values(file, "sim/a", {1, 4});
    write_values(file, "sim/b", {2, 5});
    write_values(file, "sim/c", {3, 6});
    write_values(file, "sim/where", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "sim/table", {1, 2, 3, 70, 4, 5, 6, 80, 7, 8, 9, 90, 0, 0, 0, 0, 1, 1, 1, 1},
                 4);
    write_values(file, "sim/short", {1});
    write_records(file, "list", {"px", "py", "pz", "m"}, {1, 2, 3, 10, 4, 5, 6, 20});
    write_values(file, "stars/q", {1, 2, 3}, 3);
  }
  std::unique_ptr<Snapshot> open(const std::vector<std::string>& columns) const {
    return open_snapshot(path_, {columns});
  }
  std::string refusal_of(const std::vector<std::string>& columns) const {
    try {
      open(columns);
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "any.h5";
};

TEST_F(NamedColumns, AreDatasetsByTheirPaths) {
  const auto snapshot = open({"x [kpc]=sim/a", "y=/sim/b", "z = sim/c", "mass=sim/a"});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(1, 4));
  EXPECT_EQ(require_field(snapshot->info(), 0, "position").unit, "kpc");
}

TEST_F(NamedColumns, AreMembersOfRecords) {
  const auto snapshot = open({"x=list:px", "y=list:py", "z=list:pz", "mass=list:m"});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(10, 20));
}

TEST_F(NamedColumns, AreColumnsOfATableByTheirNumbersFromOne) {
  const auto snapshot = open({"x=sim/table:1", "y=sim/table:2", "z=sim/table:3", "m=sim/table:4"});
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(70, 80, 90, 0, 1));
  EXPECT_THAT(refusal_of({"x=sim/table:5"}), HasSubstr("a number from 1 to 4"));
  EXPECT_THAT(refusal_of({"x=sim/table:0"}), HasSubstr("a number from 1 to 4"));
}

TEST_F(NamedColumns, MayBeVectorsOfATypeThatTheGroupNames) {
  const auto snapshot = open({"position=stars/q"});
  EXPECT_THAT(absolute_positions(*snapshot, 4), ElementsAre(1, 2, 3));
}

TEST_F(NamedColumns, AreLookedForInTheGroupOfThePath) {
  const auto snapshot = open_snapshot(path_ / "sim", {{"position=where"}});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(NamedColumns, ThatAreNotThereAreRefusedWithWhatIs) {
  EXPECT_THAT(refusal_of({"x=sim/d"}),
              AllOf(HasSubstr("no such dataset"), HasSubstr("sim/table (5 x 4)")));
  EXPECT_THAT(refusal_of({"x=list:pxx"}),
              AllOf(HasSubstr("one of px, py, pz, m"), HasSubstr("did you mean px?")));
}

TEST_F(NamedColumns, OfWrongShapesAreRefused) {
  EXPECT_THAT(refusal_of({"x=sim/table"}), HasSubstr("4 numbers in each row"));
  EXPECT_THAT(refusal_of({"x=list"}), HasSubstr("\"list:px\""));
  EXPECT_THAT(refusal_of({"x=sim/a", "y=sim/b", "z=sim/short"}),
              HasSubstr("x with 2 rows and z with 1"));
  EXPECT_THAT(refusal_of({"x", "y", "z"}), HasSubstr("expected NAME=DATASET"));
}

TEST_F(NamedColumns, MayBeThoseOfASnapshotWithAHeader) {
  {
    const Hdf5Output file = create_hdf5(path_);
    make_group(file, "Header");
    write_attribute(file, "Header", "NumPart_ThisFile", {2, 0});
    write_attribute(file, "Header", "Time", {0.5});
    write_values(file, "PartType0/Coordinates", {1, 2, 3, 4, 5, 6}, 3);
    write_values(file, "PartType0/CenterOfMass", {7, 8, 9, 1, 2, 3}, 3);
  }
  const auto snapshot = open({"position=PartType0/CenterOfMass"});
  EXPECT_THAT(absolute_positions(*snapshot, 0), ElementsAre(7, 8, 9, 1, 2, 3));
  EXPECT_EQ(snapshot->info().time, 0.5);
}

}  // namespace
}  // namespace splotchcl::test
