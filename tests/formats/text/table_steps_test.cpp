// Tables that hold several times one below the other.
#include "formats/snapshot_checks.h"
#include "formats/snapshot_format.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class TableOfSteps : public ::testing::Test {
 protected:
  void write(const std::string& text) const { write_bytes(path_, text); }
  std::string refusal_of(const std::string& step) const {
    return refusal_by<DataError>([&] { open_snapshot(path_ / step); });
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "table";
  const std::string three_ =
      "step,id,x,y,z\n0,1,1,2,3\n0,2,4,5,6\n2,1,7,8,9\n2,2,1,1,1\n10,1,2,2,2\n10,2,3,3,3\n";
};

TEST_F(TableOfSteps, IsReadAsItsLastOneWithANote) {
  write(three_);
  const auto last = open_snapshot(path_);
  EXPECT_EQ(last->info().types.front().count, 2U);
  EXPECT_THAT(absolute_positions(*last, 0), ElementsAre(2, 2, 2, 3, 3, 3));
  EXPECT_THAT(last->read_ids(0), ElementsAre(1, 2));
  EXPECT_THAT(last->info().notes,
              ElementsAre(AllOf(HasSubstr("3 steps in time, step=0 to step=10: the last is read"),
                                HasSubstr("table/step=0 as the snapshot"))));
}

TEST_F(TableOfSteps, GivesAnyOfThemByItsName) {
  write(three_);
  const auto second = open_snapshot(path_ / "step=2");
  EXPECT_THAT(absolute_positions(*second, 0), ElementsAre(7, 8, 9, 1, 1, 1));
  EXPECT_EQ(second->info().files, std::vector<std::filesystem::path>{path_});
  EXPECT_THAT(second->info().notes, IsEmpty());
  EXPECT_EQ(open_snapshot(path_ / "step=all")->info().types.front().count, 6U);
  EXPECT_THAT(text_table_format().groups_in(path_, ""), ElementsAre("step=0", "step=2", "step=10"));
}

TEST_F(TableOfSteps, RefusesOthersWithThoseThatItHas) {
  write(three_);
  for (const std::string step : {"step=1", "step=", "time=2", "Step#2"})
    EXPECT_THAT(refusal_of(step), HasSubstr("expected one of 3 steps in time, step=0 to step=10"));
  write("x,y,z\n1,2,3\n4,5,6\n");
  EXPECT_THAT(refusal_of("step=1"), HasSubstr("no steps in time in the table"));
}

// Also where each particle has its times together.
TEST_F(TableOfSteps, MayTellItsTimes) {
  write("# Time x y z\n0.5 1 1 1\n1.5 2 2 2\n0.5 3 3 3\n1.5 4 4 4\n");
  const auto last = open_snapshot(path_);
  EXPECT_EQ(last->info().time, 1.5);
  EXPECT_THAT(absolute_positions(*last, 0), ElementsAre(2, 2, 2, 4, 4, 4));
  EXPECT_EQ(open_snapshot(path_ / "Time=0.5")->info().time, 0.5);
}

TEST_F(TableOfSteps, MayTellRedshiftsWhereParticlesAreThereAgain) {
  const std::string rows = "3 1 1 1 1\n3 2 2 2 2\n0 1 3 3 3\n0 2 4 4 4\n";
  write("redshift id x y z\n" + rows);
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0), ElementsAre(3, 3, 3, 4, 4, 4));
  EXPECT_EQ(open_snapshot(path_)->info().redshift, 0);
  EXPECT_EQ(open_snapshot(path_ / "redshift=3")->info().redshift, 3);
  for (const std::string header : {"t pid x y z\n", "scale id x y z\n"}) {
    write(header + rows);
    EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0), ElementsAre(1, 1, 1, 2, 2, 2));
  }
  write("t w x y z\n" + rows);
  EXPECT_EQ(open_snapshot(path_)->info().types.front().count, 4U);
}

// Of a light cone each particle has its own; of one state all have the same.
TEST_F(TableOfSteps, IsNoneWhereNoParticleIsThereTwice) {
  for (const std::string text : {"snapshot id x y z\n1 1 1 1 1\n1 2 2 2 2\n2 3 3 3 3\n2 4 4 4 4\n",
                                 "time x y z\n1 1 1 1\n2 2 2 2\n3 3 3 3\n4 4 4 4\n",
                                 "step x y z\n1 1 1 1\n1 2 2 2\n1 3 3 3\n1 4 4 4\n",
                                 "step x y z\nnan 1 1 1\n1 2 2 2\n2 3 3 3\n2 4 4 4\n",
                                 "time_step x y z\n1 1 1 1\n1 2 2 2\n2 3 3 3\n2 4 4 4\n"}) {
    write(text);
    const auto snapshot = open_snapshot(path_);
    EXPECT_EQ(snapshot->info().types.front().count, 4U) << text;
    EXPECT_THAT(snapshot->info().notes, IsEmpty()) << text;
  }
}

}  // namespace
}  // namespace splotchcl::test
