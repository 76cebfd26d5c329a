#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_checks.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::test {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

class OpenPmd : public ::testing::Test {
 protected:
  // Positions in micrometers, from points in millimeters; y has one such point for all.
  void write(const std::vector<std::string>& iterations,
             const std::vector<std::string>& species) const {
    const Hdf5Output file = create_hdf5(path_);
    write_text(file, "/", "openPMD", "1.1.0");
    double time = 0;
    for (const std::string& iteration : iterations) {
      time += 0.25;
      for (const std::string& name : species)
        write_species(file, "data/" + iteration + "/particles/" + name, time);
      write_attribute(file, "data/" + iteration, "time", {time});
    }
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "plasma.h5";

 private:
  static void write_species(const Hdf5Output& file, const std::string& group, double time) {
    for (const char* const axis : {"x", "y", "z"}) {
      const std::string position = group + "/position/" + axis;
      write_values(file, position, {1 + time, 2 + time});
      write_attribute(file, position, "unitSI", {1e-6});
      const std::string offset = group + "/positionOffset/" + axis;
      if (axis == std::string("y")) {
        write_constant(file, group + "/positionOffset", axis, 3);
      } else {
        write_values(file, offset, {1, 2});
      }
      write_attribute(file, offset, "unitSI", {1e-3});
    }
    write_attribute(file, group + "/position", "unitDimension", {1, 0, 0, 0, 0, 0, 0});
    write_constant(file, group, "mass", 9.5);
    write_attribute(file, group + "/mass", "unitSI", {1});
    write_attribute(file, group + "/mass", "unitDimension", {0, 1, 0, 0, 0, 0, 0});
    write_values(file, group + "/id", {4294967297.0, 5}, 1, H5T_STD_U64LE);
  }
  static void write_constant(const Hdf5Output& file, const std::string& group,
                             const std::string& name, double value) {
    make_group(file, group + "/" + name);
    write_attribute(file, group + "/" + name, "value", {value});
    write_attribute(file, group + "/" + name, "shape", {2}, H5T_STD_U64LE);
  }
};

TEST_F(OpenPmd, PositionsAreFromTheirOffsets) {
  write({"100"}, {"e"});
  const auto snapshot = open_snapshot(path_);
  EXPECT_EQ(snapshot->info().format, "HDF5 of openPMD");
  EXPECT_THAT(absolute_positions(*snapshot, 0),
              Pointwise(DoubleNear(1e-9), {1001.25, 3001.25, 1001.25, 2002.25, 3002.25, 2002.25}));
  EXPECT_EQ(require_field(snapshot->info(), 0, "position").unit, "1e-06 m");
  EXPECT_THAT(snapshot->info().notes, IsEmpty());
}

TEST_F(OpenPmd, ConstantsAreTheSameForAll) {
  write({"100"}, {"e"});
  const auto snapshot = open_snapshot(path_);
  EXPECT_THAT(values_of(snapshot->read(0, "mass")), ElementsAre(9.5, 9.5));
  EXPECT_EQ(require_field(snapshot->info(), 0, "mass").unit, "kg");
  EXPECT_THAT(snapshot->read_ids(0), ElementsAre(4294967297U, 5U));
}

TEST_F(OpenPmd, OfIterationsTheLastIsRead) {
  write({"5", "20", "100"}, {"electrons", "ions"});
  const auto last = open_snapshot(path_);
  EXPECT_EQ(last->info().time, 0.75);
  EXPECT_EQ(last->info().types.size(), 2U);
  EXPECT_THAT(last->info().notes, Contains(HasSubstr("3 steps in time, /data/5 to /data/100")));
  EXPECT_THAT(absolute_positions(*last, 1), Contains(1001.75));
}

TEST_F(OpenPmd, AnIterationIsASnapshotByItsPath) {
  write({"5", "20", "100"}, {"electrons", "ions"});
  const auto second = open_snapshot(path_ / "data/20");
  EXPECT_EQ(second->info().time, 0.5);
  EXPECT_EQ(second->info().types.size(), 2U);
  EXPECT_EQ(second->info().files, std::vector<std::filesystem::path>{path_});
  const auto ions = open_snapshot(path_ / "data/20/particles/ions");
  EXPECT_EQ(ions->info().types.size(), 1U);
}

}  // namespace
}  // namespace splotchcl::test
