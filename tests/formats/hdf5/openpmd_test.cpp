#include "formats/hdf5/hdf5_values.h"
#include "formats/snapshot_rows.h"

namespace splotchcl::test {
namespace {

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

TEST_F(OpenPmd, PositionsAreFromTheirOffsetsAndConstantsTheSameForAll) {
  write({"100"}, {"e"});
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 0),
              Pointwise(DoubleNear(1e-9), {1001.25, 3001.25, 1001.25, 2002.25, 3002.25, 2002.25}));
  expect_snapshot(path_, {},
                  "format HDF5 of openPMD | unit position 1e-06 m | no notes | mass 9.5 9.5 | "
                  "unit mass kg | ids 4294967297 5");
}

TEST_F(OpenPmd, OfIterationsTheLastIsReadOrTheOneOfThePath) {
  write({"5", "20", "100"}, {"electrons", "ions"});
  expect_snapshot(path_, {}, "time 0.75 | types 2 | note 3 steps in time, /data/5 to /data/100");
  EXPECT_THAT(absolute_positions(*open_snapshot(path_), 1), Contains(1001.75));
  expect_snapshot(path_ / "data/20", {}, "time 0.5 | types 2");
  EXPECT_EQ(open_snapshot(path_ / "data/20")->info().files,
            std::vector<std::filesystem::path>{path_});
  expect_snapshot(path_ / "data/20/particles/ions", {}, "types 1");
}

}  // namespace
}  // namespace splotchcl::test
