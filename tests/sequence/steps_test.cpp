// Sequences of steps in one file, and of files whose columns have to be named.
#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_writer.h"
#include "sequence/list_sequence.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot_source.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class SequenceOfSteps : public ::testing::Test {
 protected:
  SequenceOfSteps() {
    const Hdf5Output file = create_hdf5(file_);
    for (const int step : {0, 5, 20, 12000}) {
      const std::string group = "data/" + std::to_string(step);
      write_values(file, group + "/particles/gas/pos", {1, 2, 3, 4, 5, 6}, 3);
      write_values(file, group + "/particles/gas/ids", {7, 8}, 1, H5T_STD_U64LE);
      write_values(file, group + "/particles/gas/mass", {step + 1.0, step + 3.0});
      write_attribute(file, group, "time", {0.5 * step});
    }
  }
  Scene scene(const std::string& pattern, double index) const {
    Scene scene;
    scene.time.pattern = (folder_ / pattern).string();
    scene.time.index = index;
    return scene;
  }
  static std::vector<double> indices(const Scene& scene) {
    std::vector<double> found;
    for (const ListedSnapshot& listed : list_sequence(scene.time))
      found.push_back(listed.index);
    return found;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "run.h5";
};

TEST_F(SequenceOfSteps, HasThoseThatTheFileHas) {
  EXPECT_THAT(indices(scene("run.h5/data/%d", 0)), ElementsAre(0, 5, 20, 12000));
  Scene some = scene("run.h5/data/%d", 0);
  some.time.first = 1;
  some.time.last = 20;
  EXPECT_THAT(indices(some), ElementsAre(5, 20));
}

TEST_F(SequenceOfSteps, IsReadBetweenTwo) {
  SnapshotSource source;
  const auto between = source.at(scene("run.h5/data/%d", 12.5));
  EXPECT_EQ(between->info().time, 6.25);
  const Column mass = between->read(0, "mass");
  EXPECT_FLOAT_EQ(mass[0], 13.5F);
}

TEST_F(SequenceOfSteps, OfOtherNamesIsRefused) {
  EXPECT_THAT([&] { indices(scene("run.h5/steps/%d", 0)); },
              ThrowsMessage<UsageError>(HasSubstr("found no group %d in")));
  EXPECT_THAT([&] { indices(scene("run.h5/data/%07d", 0)); },
              ThrowsMessage<UsageError>(HasSubstr("found no group %07d in")));
}

TEST_F(SequenceOfSteps, MayHaveColumnsThatAreNamed) {
  for (const int number : {1, 2}) {
    write_bytes(folder_ / ("table_" + std::to_string(number) + ".txt"),
                "some words\n9 9\n" + std::to_string(number) + " 2 3\n");
  }
  Scene tables = scene("table_%d.txt", 2);
  tables.time.interpolation = Interpolation::none;
  tables.read.columns = {"x", "y", "z"};
  tables.read.skip_lines = 2;
  SnapshotSource source;
  source.check(tables);
  const auto second = source.at(tables);
  EXPECT_EQ(second->read(0, "position")[0] + second->position_origin().a[0], 2);
  tables.read.columns = {"y", "x", "z"};
  const auto otherwise = source.at(tables);
  EXPECT_EQ(otherwise->read(0, "position")[1] + otherwise->position_origin().a[1], 2);
}

}  // namespace
}  // namespace splotchcl::test
