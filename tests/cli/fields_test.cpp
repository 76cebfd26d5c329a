#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

std::map<std::string, Json> fields_by_name(const Json& list, int type) {
  std::map<std::string, Json> fields;
  for (const Json& field : list) {
    if (field["type"] == type) fields[field["field"]] = field;
  }
  return fields;
}

TEST(Fields, AreListedByTheNamesThatScenesUse) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  const ProgramResult result = splotchcl_in(folder, "fields u --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto gas = fields_by_name(Json::parse(result.out), 0);
  EXPECT_EQ(gas.at("density")["particles"], 1700);
  EXPECT_EQ(gas.at("velocity")["values_per_particle"], 3);
  EXPECT_GE(gas.at("position_x")["minimum"], 0);
  EXPECT_LE(gas.at("position_x")["maximum"], 50000);
  EXPECT_EQ(gas.at("temperature")["is_derived"], true);
  EXPECT_EQ(gas.at("temperature")["unit"], "K");
  for (const auto& [name, field] : gas) {
    if (field["values_per_particle"] > 1 || name == "radius") continue;
    const std::string setting = " --set component.0.color.field=" + name;
    const ProgramResult drawn = splotchcl_in(folder, "render u --explain" + setting);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  }
}

TEST(Fields, HaveOneLineEachInText) {
  const TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << "x,y,z,mass\n1,2,3,4\n2,3,4,nan\n";
  const ProgramResult result = splotchcl_in(folder, "fields table.csv");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::ContainsRegex("gas +mass +2 +4 +4 +1"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("gas +position_z +2 +3 +4 +0"));
}

TEST(Fields, HaveAUnitOfDensityWhereOtherUnitsTellIt) {
  const TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << "x [kpc],y [kpc],z [kpc],mass [g]\n1,2,3,4\n2,3,4,5\n";
  const auto gas =
      fields_by_name(Json::parse(splotchcl_in(folder, "fields table.csv --json").out), 0);
  EXPECT_EQ(gas.at("density")["unit"], "g/kpc^3");
}

TEST(Fields, OfAFileThatIsNoSnapshotAreRefused) {
  const TemporaryFolder folder;
  const ProgramResult result = splotchcl_in(folder, "fields missing");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(is_one_line(result.err)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("missing"));
}

}  // namespace
}  // namespace splotchcl::test
