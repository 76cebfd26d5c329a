#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

using ::testing::HasSubstr;
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
                ::testing::ThrowsMessage<UsageError>(HasSubstr("a table of strings by name")))
        << value;
  }
}

}  // namespace
}  // namespace splotchcl
