#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using ::testing::UnorderedElementsAre;

const std::string start = "snapshot = \"s\"\n[[component]]\ntypes = [0]\n";

TEST(ReadColumns, MayBeATableOfNamesAndColumns) {
  const Scene scene = parse_scene(
      start + "[read]\ncolumns = {x = \"a/b\", \"y [kpc]\" = \"list:y\", z = 3}\n", "scene.toml");
  EXPECT_THAT(scene.read.columns, UnorderedElementsAre("x=a/b", "y [kpc]=list:y", "z=3"));
}

TEST(ReadColumns, AreWrittenAsTheyAreRead) {
  const Scene scene = parse_scene(start + "[read.columns]\nx = \"a/b\"\n", "scene.toml");
  EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.columns, scene.read.columns);
}

TEST(ReadColumns, OfOtherKindsAreRefused) {
  for (const char* const value : {"{x = true}", "{}", "{x = \"\"}", "{\"x=y\" = \"a\"}"}) {
    EXPECT_THAT([&] { parse_scene(start + "[read]\ncolumns = " + value + "\n", "scene.toml"); },
                ThrowsMessage<UsageError>(HasSubstr("a table of strings by name")))
        << value;
  }
}

TEST(ReadUnits, AreATableOfFieldsAndUnits) {
  const Scene scene = parse_scene(
      start + "[read]\nunits = {mass = \"Msun\", position = \"kpc/h a\"}\n", "scene.toml");
  EXPECT_THAT(scene.read.units, UnorderedElementsAre("mass=Msun", "position=kpc/h a"));
  EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.units, scene.read.units);
}

TEST(ReadUnits, MayBeOfASystem) {
  for (const char* const value : {"\"gadget\"", "[\"gadget\"]"}) {
    const Scene scene = parse_scene(start + "[read]\nunits = " + value + "\n", "scene.toml");
    EXPECT_THAT(scene.read.units, UnorderedElementsAre("gadget"));
    EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").read.units, scene.read.units);
  }
  EXPECT_THAT(apply_settings(Scene(), {"read.units=gadget"}).read.units,
              UnorderedElementsAre("gadget"));
}

TEST(Haloes, HaveNumbersOfAnyLength) {
  for (const std::uint64_t number :
       {std::uint64_t{0}, std::uint64_t{9007199254740993U}, std::uint64_t{18446744073709551615U}}) {
    const Scene scene =
        parse_scene(start + "select.halo = \"" + std::to_string(number) + "\"\n", "scene.toml");
    EXPECT_EQ(scene.components.front().select.halo, number);
    EXPECT_EQ(parse_scene(format_scene(scene), "again.toml").components.front().select.halo,
              number);
  }
}

}  // namespace
}  // namespace splotchcl
