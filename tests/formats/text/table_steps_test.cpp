// Tables that hold several times one below the other.
#include "formats/snapshot_format.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

const std::string three =
    "step,id,x,y,z\n0,1,1,2,3\n0,2,4,5,6\n2,1,7,8,9\n2,2,1,1,1\n10,1,2,2,2\n10,2,3,3,3\n";
// Also where each particle has its times together.
const std::string times = "# Time x y z\n0.5 1 1 1\n1.5 2 2 2\n0.5 3 3 3\n1.5 4 4 4\n";
const std::string twice = "3 1 1 1 1\n3 2 2 2 2\n0 1 3 3 3\n0 2 4 4 4\n";

struct StepsRow {
  std::string table, step;  // "": the table as such
  const char* expected;     // as of SnapshotRow
};

TEST(TableOfSteps, IsReadAsItsLastOneOrTheOneThatIsNamed) {
  const std::string others = "refused expected one of 3 steps in time, step=0 to step=10";
  for (const auto& [table, step, expected] : std::vector<StepsRow>{
           {three, "",
            "count 2 | position 2 2 2 3 3 3 | ids 1 2 | notes 1 | "
            "note 3 steps in time, step=0 to step=10: the last is read | "
            "note table/step=0 as the snapshot"},
           {three, "step=2", "position 7 8 9 1 1 1 | no notes"},
           {three, "step=all", "count 6"},
           {three, "step=1", others.c_str()},
           {three, "step=", others.c_str()},
           {three, "time=2", others.c_str()},
           {three, "Step#2", others.c_str()},
           {"x,y,z\n1,2,3\n4,5,6\n", "step=1", "refused no steps in time in the table"},
           {times, "", "time 1.5 | position 2 2 2 4 4 4"},
           {times, "Time=0.5", "time 0.5"},
           // Redshifts and ages, where particles are there again.
           {"redshift id x y z\n" + twice, "", "position 3 3 3 4 4 4 | redshift 0"},
           {"redshift id x y z\n" + twice, "redshift=3", "redshift 3"},
           {"t pid x y z\n" + twice, "", "position 1 1 1 2 2 2"},
           {"scale id x y z\n" + twice, "", "position 1 1 1 2 2 2"},
           {"t w x y z\n" + twice, "", "count 4"},
           // Of a light cone each particle has its own; of one state all have the same.
           {"snapshot id x y z\n1 1 1 1 1\n1 2 2 2 2\n2 3 3 3 3\n2 4 4 4 4\n", "",
            "count 4 | no notes"},
           {"time x y z\n1 1 1 1\n2 2 2 2\n3 3 3 3\n4 4 4 4\n", "", "count 4 | no notes"},
           {"step x y z\n1 1 1 1\n1 2 2 2\n1 3 3 3\n1 4 4 4\n", "", "count 4 | no notes"},
           {"step x y z\nnan 1 1 1\n1 2 2 2\n2 3 3 3\n2 4 4 4\n", "", "count 4 | no notes"},
           {"time_step x y z\n1 1 1 1\n1 2 2 2\n2 3 3 3\n2 4 4 4\n", "", "count 4 | no notes"}}) {
    SCOPED_TRACE(table + step);
    const TemporaryFolder folder;
    write_bytes(folder / "table", table);
    expect_snapshot(step.empty() ? folder / "table" : folder / "table" / step, {}, expected);
  }
}

TEST(TableOfSteps, TellsItsFileAndItsSteps) {
  const TemporaryFolder folder;
  write_bytes(folder / "table", three);
  EXPECT_EQ(open_snapshot(folder / "table" / "step=2")->info().files,
            std::vector<std::filesystem::path>{folder / "table"});
  EXPECT_THAT(text_table_format().groups_in(folder / "table", ""),
              ElementsAre("step=0", "step=2", "step=10"));
}

}  // namespace
}  // namespace splotchcl::test
