#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Info, ListsFieldsWithRangeMeanAndBadValues) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  const ProgramResult result = splotchcl_in(folder, "info u --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["box_size"], 50000);
  EXPECT_EQ(json["types"][0]["name"], "gas");
  EXPECT_EQ(json["types"][0]["count"], 1700);
  int positions = 0;
  for (const auto& field : json["types"][0]["fields"]) {
    EXPECT_EQ(field["bad"], 0) << field;
    EXPECT_LE(field["minimum"], field["mean"]) << field;
    EXPECT_LE(field["mean"], field["maximum"]) << field;
    if (std::string(field["name"]).find("position ") == 0) ++positions;
  }
  EXPECT_EQ(positions, 3);
}

TEST(Info, EndsWithTheSceneFileThatRenderUses) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate universe -o u --particles 2000").exit_code, 0);
  const std::string info = splotchcl_in(folder, "info u").out;
  const std::string explained = splotchcl_in(folder, "render u --explain").out;
  const std::string scene = explained.substr(explained.find("snapshot = "));
  EXPECT_THAT(info, HasSubstr(scene));
}

TEST(Info, CountsBadValues) {
  const TemporaryFolder folder;
  ASSERT_EQ(splotchcl_in(folder, "generate halo -o h --particles 2000 --stars 0").exit_code, 0);
  {
    // The first value of the last block, HSML: before it end marker and 2000 floats.
    std::fstream file(folder / "h", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-4 - 2000 * 4, std::ios::end);
    const float bad = std::numeric_limits<float>::quiet_NaN();
    file.write(reinterpret_cast<const char*>(&bad), sizeof bad);
  }
  const auto json = nlohmann::json::parse(splotchcl_in(folder, "info h --json").out);
  for (const auto& field : json["types"][0]["fields"]) {
    EXPECT_EQ(field["bad"], field["name"] == "smoothing_length" ? 1 : 0) << field;
  }
}

TEST(Info, WritesJsonAndNoControlCharactersWhateverFieldsAreCalled) {
  const TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << "x,y,z,caf\xe9\x1b[31m\n1,2,3,4\n2,3,4,5\n";
  for (const std::string options : {"--json", "--json --header"}) {
    const ProgramResult result = splotchcl_in(folder, "info table.csv " + options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(nlohmann::json::accept(result.out)) << result.out;
  }
  EXPECT_THAT(splotchcl_in(folder, "info table.csv").out,
              AllOf(HasSubstr("?[31m"), ::testing::Not(HasSubstr("\x1b"))));
}

TEST(Info, WritesNoControlCharactersWhateverTheFileIsCalled) {
  const TemporaryFolder folder;
  // To begin commands of a terminal there is a character of one byte, and one of two.
  for (const std::string name : {"a\x1b[31m.csv", "a\u009b31m.csv"}) {
    std::ofstream(folder / name) << "x,y,z,v [\x1b[31m]\n1,2,3,4\n2,3,4,5\n";
    for (const std::string command : {"info", "info --json", "info --header", "fields",
                                      "render --reference --size 8x8 -o a.png --explain"}) {
      const ProgramResult result = splotchcl_in(folder, command + " '" + name + "'");
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ((result.out + result.err).find('\x1b'), std::string::npos) << command;
      EXPECT_EQ((result.out + result.err).find("\u009b"), std::string::npos) << command;
    }
  }
}

TEST(Info, NamesAFileThatIsNoSnapshot) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text") << "neither snapshot nor scene, but long enough for a header\n";
  for (const std::string name : {"text", "missing"}) {
    const ProgramResult result = splotchcl_in(folder, "info " + name);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_THAT(result.err, HasSubstr(name));
  }
}

}  // namespace
}  // namespace splotchcl::test
