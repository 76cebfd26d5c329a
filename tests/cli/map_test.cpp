#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A small universe, 3400 gas and 600 star particles.
class MapCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    ASSERT_EQ(splotchcl_in(folder_, "generate universe -o u --particles 4000").exit_code, 0);
  }
  ProgramResult map(const std::string& arguments) {
    return splotchcl_in(folder_, "map " + arguments);
  }
  bool exists(const char* name) const { return std::filesystem::exists(folder_ / name); }
  void expect_wrong_call(const std::string& arguments, const std::string& part_of_message) {
    const ProgramResult result = map(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, AllOf(StartsWith("splotchcl: "), HasSubstr(part_of_message)));
  }
  TemporaryFolder folder_;
};

TEST_F(MapCommand, WritesOneMapInSeveralFormats) {
  const ProgramResult result =
      map("u --quantity temperature --unit K --size 400x300 -o t.fits -o t.npy -o t.png "
          "-o t.h5 -o t.pdf -o t.exr --contours 3 --center mass --noise");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(exists("t.fits") && exists("t.npy") && exists("t.png") && exists("t.h5"));
  EXPECT_TRUE(exists("t.pdf") && exists("t.exr"));
}

TEST_F(MapCommand, TakesItsSettingsFromTheSceneToo) {
  std::ofstream(folder_ / "s.toml") << "snapshot = 'u'\n[map]\nquantity = 'temprature'\n"
                                       "[[component]]\nname = 'gas'\ntypes = 'gas'\n";
  expect_wrong_call("s.toml -o t.fits", "temprature");
}

TEST_F(MapCommand, MapsTheTypesThatItIsAskedFor) {
  EXPECT_EQ(map("u --types stars --size 64x64 -o s.npy").exit_code, 0);
  expect_wrong_call("u --types boundary --size 64x64 -o s.npy", "found boundary, of which");
}

TEST_F(MapCommand, DoesNotTellOfTypesThatItIsNotAskedFor) {
  EXPECT_EQ(map("u --types stars --size 64x64 -o s.npy").err.find("not drawn"), std::string::npos);
}

TEST_F(MapCommand, OfAnEmptySelectionWithoutABoxAsksForItsPlace) {
  const std::string none = "u --set map.periodic=false --select 'temperature > 1e20' -o s.npy";
  expect_wrong_call(none, "set map.center and map.width");
  EXPECT_EQ(map(none + " --center 1,1,1 --width 1 --size 64x64").exit_code, 0);
}

TEST_F(MapCommand, LeavesTheFolderOfASnapshotWhatItWas) {
  std::filesystem::create_directory(folder_ / "run");
  std::filesystem::rename(folder_ / "u", folder_ / "run/u");
  EXPECT_EQ(map("run -o run/s.hdf5 -o run/s.npy -o run/s.fits -o run/s.png --size 64x64 --noise")
                .exit_code,
            0);
  EXPECT_EQ(splotchcl_in(folder_, "info run").exit_code, 0);
}

TEST_F(MapCommand, KnowsTheSkyWhereItKnowsLengths) {
  const std::string sky = "u --size 64x64 --distance '10 Mpc' --sky 187.7,12.4 -o s.fits";
  expect_wrong_call(sky, "map.length_unit");
  EXPECT_EQ(map(sky + " --set map.length_unit=kpc").exit_code, 0);
  expect_wrong_call("u --sky 187.7,112.4 --distance '10 Mpc' -o s.fits", "declination");
}

TEST_F(MapCommand, RefusesWhatItCannotWriteBeforeItReads) {
  expect_wrong_call("u -o t.tif", "holds light");
}

TEST_F(MapCommand, NeverGuessesUnits) {
  expect_wrong_call("u --unit Msun/pc^2 --size 64x64 -o t.npy", "map.length_unit");
}

}  // namespace
}  // namespace splotchcl::test
