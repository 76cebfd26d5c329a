#include "scene_file/scene_checks.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::message_for;

struct Refused {
  std::string text;
  std::string message;  // the start of it
};

void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.text;
}

class SceneFileRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(SceneFileRefuses, InOneLineThatSaysWhere) {
  const std::string message = message_for(GetParam().text);
  EXPECT_THAT(message, StartsWith(GetParam().message));
  EXPECT_THAT(message, HasSubstr("expected"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

const std::string camera = "[camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, 1]\n";
const std::string component = "[[component]]\n";

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, SceneFileRefuses,
    ::testing::Values(
        Refused{"tolerence = 1", "scene.toml:1: key tolerence: found an unknown key"},
        Refused{"\n\n[imgae]\nsize = [1, 1]", "scene.toml:3: key imgae: found an unknown key"},
        Refused{"[nothing]", "scene.toml:1: key nothing: found an unknown key"},
        Refused{camera + "fov = 3", "scene.toml:4: key camera.fov: found an unknown key"},
        Refused{component + "\ncolour.field = \"U\"", "scene.toml:3: key component.0.colour"},
        Refused{component + component + "color = { feild = \"U\" }",
                "scene.toml:3: key component.1.color.feild"},
        Refused{"\"image.size\" = [1, 1]", "scene.toml:1: key image.size: found an unknown key"},
        Refused{"\"\" = 1", "scene.toml:1: key : found an unknown key"},
        Refused{"\"a\\nb\" = 1", "scene.toml:1: key a b: found an unknown key"}));

INSTANTIATE_TEST_SUITE_P(
    WrongTypes, SceneFileRefuses,
    ::testing::Values(
        Refused{"snapshot = 1", "scene.toml:1: key snapshot: found integer 1"},
        Refused{"snapshot = \"\"", "scene.toml:1: key snapshot: found string \"\""},
        Refused{"tolerance = \"small\"", "scene.toml:1: key tolerance: found string \"small\""},
        Refused{"tolerance = true", "scene.toml:1: key tolerance: found boolean true"},
        Refused{"tolerance = 2024-01-01", "scene.toml:1: key tolerance: found date 2024-01-01"},
        Refused{"tolerance = {}", "scene.toml:1: key tolerance: found table"},
        Refused{"image = 3", "scene.toml:1: key image: found integer 3, expected a table"},
        Refused{"[[image]]", "scene.toml:1: key image: found array"},
        Refused{"[image]\nsize = 3", "scene.toml:2: key image.size: found integer 3"},
        Refused{"[image]\nsize = [1]", "scene.toml:2: key image.size: found array [ 1 ]"},
        Refused{"[image]\nsize = [1, 2, 3]", "scene.toml:2: key image.size: found array"},
        Refused{"[image]\nsize = [1.5, 2]", "scene.toml:2: key image.size: found array"},
        Refused{"[image]\nwidth = 640.0", "scene.toml:2: key image.width: found floating-point"},
        Refused{"[image]\nbackground = [1, 2]", "scene.toml:2: key image.background: found array"},
        Refused{"[image]\nbackground = [1, 2, \"3\"]", "scene.toml:2: key image.background"},
        Refused{"[camera]\nposition = [1, [2], 3]", "scene.toml:2: key camera.position: found"},
        Refused{camera + "projection = \"fish\"", "scene.toml:4: key camera.projection"},
        Refused{"component = 3", "scene.toml:1: key component: found integer 3"},
        Refused{"component = [1]", "scene.toml:1: key component: found array"},
        Refused{"component = []", "scene.toml:1: key component: found array"},
        Refused{"[component]", "scene.toml:1: key component: found table"},
        Refused{component + "color = \"U\"", "scene.toml:2: key component.0.color: found string"},
        Refused{component + "types = []", "scene.toml:2: key component.0.types: found array"},
        Refused{component + "types = [0, 0]", "scene.toml:2: key component.0.types: found array"},
        Refused{component + "types = [\"ghosts\"]", "scene.toml:2: key component.0.types"},
        Refused{component + "types = 1.0", "scene.toml:2: key component.0.types: found floating"},
        Refused{component + "absorption = \"some\"", "scene.toml:2: key component.0.absorption"},
        Refused{component + "weight = \"heavy\"", "scene.toml:2: key component.0.weight"}));

INSTANTIATE_TEST_SUITE_P(
    OutOfRange, SceneFileRefuses,
    ::testing::Values(
        Refused{"tolerance = -0.1", "scene.toml:1: key tolerance: found floating-point -0.1"},
        Refused{"tolerance = 1.5", "scene.toml:1: key tolerance: found floating-point 1.5"},
        Refused{"tolerance = nan", "scene.toml:1: key tolerance: found floating-point nan"},
        Refused{"tolerance = inf", "scene.toml:1: key tolerance: found floating-point inf"},
        Refused{"[image]\nsize = [0, 10]", "scene.toml:2: key image.size: found array"},
        Refused{"[image]\nwidth = -1", "scene.toml:2: key image.width: found integer -1"},
        Refused{"[image]\nwidth = 65537", "scene.toml:2: key image.width: found integer 65537"},
        Refused{"[image]\nwidth = 4294967297", "scene.toml:2: key image.width: found integer"},
        Refused{"[image]\nsize = [65536, 65536]",
                "scene.toml:2: key image.size: found 65536 x 65536"},
        Refused{"[image]\nbackground = [0, -1, 0]", "scene.toml:2: key image.background"},
        Refused{"[image]\ngamma = 0", "scene.toml:2: key image.gamma: found integer 0"},
        Refused{"[camera]\nposition = [inf, 0, 0]", "scene.toml:2: key camera.position: found"},
        Refused{camera + "field_of_view = 0", "scene.toml:4: key camera.field_of_view: found"},
        Refused{camera + "field_of_view = 180", "scene.toml:4: key camera.field_of_view: found"},
        Refused{camera + "near = nan", "scene.toml:4: key camera.near: found"},
        Refused{"[kernel]\nwidth = 0", "scene.toml:2: key kernel.width: found integer 0"},
        Refused{"[kernel]\ncut = 0", "scene.toml:2: key kernel.cut: found integer 0"},
        Refused{"[kernel]\nmin_radius = -1", "scene.toml:2: key kernel.min_radius: found"},
        Refused{component + "size.factor = 0", "scene.toml:2: key component.0.size.factor"},
        Refused{component + "size.fixed = -2", "scene.toml:2: key component.0.size.fixed"},
        Refused{component + "types = -1", "scene.toml:2: key component.0.types: found integer -1"},
        Refused{component + "types = 32", "scene.toml:2: key component.0.types: found integer 32"},
        Refused{component + "brightness = -1", "scene.toml:2: key component.0.brightness"},
        Refused{component + "brightness = 1e31", "scene.toml:2: key component.0.brightness"},
        Refused{component + "absorption = -1", "scene.toml:2: key component.0.absorption"},
        Refused{component + "gray_absorption = -1",
                "scene.toml:2: key component.0.gray_absorption"},
        Refused{component + "reference_column = 0", "scene.toml:2: key component.0.reference"}));

INSTANTIATE_TEST_SUITE_P(
    WhatDoesNotFitTogether, SceneFileRefuses,
    ::testing::Values(
        Refused{"[image]\nsize = [1, 1]\nwidth = 2", "scene.toml:3: key image.width: found it"},
        Refused{component + "size = { field = \"h\", fixed = 2 }",
                "scene.toml:2: key component.0.size.fixed: found it beside"},
        Refused{component + "absorption = 1\ngray_absorption = 1",
                "scene.toml:3: key component.0.gray_absorption: found it beside"},
        Refused{component + "color.min = 1", "scene.toml:2: key component.0.color.min: found a"},
        Refused{component + "intensity.scaling = \"log\"",
                "scene.toml:2: key component.0.intensity.scaling: found a value without a field"},
        Refused{component + "color = { field = \"U\", min = 2, max = 1 }",
                "scene.toml:2: key component.0.color.min: found 2"},
        Refused{component + "color = { field = \"U\", scaling = \"log\", min = 0 }",
                "scene.toml:2: key component.0.color.min: found 0"},
        Refused{component + "color = { field = \"U\", scaling = \"log\", max = -1 }",
                "scene.toml:2: key component.0.color.max: found -1"},
        Refused{component + "name = \"a\"\n" + component + "name = \"a\"",
                "scene.toml:4: key component.1.name: found \"a\", which another component has"},
        Refused{component + "name = \"12\"", "scene.toml:2: key component.0.name: found \"12\""},
        Refused{"\n[camera]\n", "scene.toml:2: key camera.position: found nothing"},
        Refused{"[camera]\nposition = [1, 2, 3]\n",
                "scene.toml:1: key camera.look_at: found nothing"},
        Refused{camera + "sky = [0, 0, -2]", "scene.toml:4: key camera.sky: found (0, 0, -2)"},
        Refused{camera + "sky = [0, 0, 0]", "scene.toml:4: key camera.sky: found (0, 0, 0)"},
        Refused{"[camera]\nposition = [0, 0, 1]\nlook_at = [0, 0, 1]",
                "scene.toml:3: key camera.look_at: found the camera's own position"},
        Refused{camera + "near = 2\nfar = 1", "scene.toml:4: key camera.near: found 2"},
        Refused{camera + "near = -1", "scene.toml:4: key camera.near: found -1"}));

INSTANTIATE_TEST_SUITE_P(
    WhatIsNoToml, SceneFileRefuses,
    ::testing::Values(Refused{"snapshot", "scene.toml:1: found no valid TOML"},
                      Refused{"\n\nsnapshot = ", "scene.toml:3: found no valid TOML"},
                      Refused{"snapshot = \"abc", "scene.toml:1: found no valid TOML"},
                      Refused{"tolerance = 1\ntolerance = 1", "scene.toml:2: found no valid TOML"},
                      Refused{"[image]\n[image]", "scene.toml:2: found no valid TOML"},
                      Refused{"tolerance = 99999999999999999999", "scene.toml:1: found no valid"},
                      Refused{"[image\nsize = [1, 1]", "scene.toml:1: found no valid TOML"},
                      Refused{"snapshot = \"\xff\xfe\"", "scene.toml:1: found no valid TOML"},
                      Refused{std::string("\0\0\0", 3), "scene.toml:1: found no valid TOML"},
                      Refused{"a = " + std::string(100000, '['), "scene.toml:1: found no valid"}));

TEST(SceneFileRange, IsOfLimitsOrOfPercentiles) {
  EXPECT_THAT(message_for(component + "color = { field = 'U', min = 1, max = 2, "
                                      "percentiles = [20, 80] }"),
              HasSubstr("key component.0.color.percentiles: found it beside min and max"));
  EXPECT_THAT(message_for("[map]\nmin = 1\nmax = 2\npercentiles = [20, 80]"),
              HasSubstr("scene.toml:4: key map.percentiles: found it beside min and max"));
}

TEST(SceneFileAdvice, NamesTheNearestKeyOfTheTable) {
  EXPECT_THAT(message_for(camera + "feild_of_view = 3"),
              HasSubstr("; did you mean camera.field_of_view?"));
  EXPECT_THAT(message_for("[imgae]"), HasSubstr("; did you mean image?"));
  EXPECT_THAT(message_for(component + "Palette = \"magma\""),
              HasSubstr("; did you mean component.0.palette?"));
  EXPECT_THAT(message_for(component + "color.filed = \"U\""),
              HasSubstr("; did you mean component.0.color.field?"));
}

TEST(SceneFileAdvice, NamesAKeyThatStandsInTheWrongTable) {
  EXPECT_THAT(message_for("background = [0, 0, 0]"), HasSubstr("; did you mean image.background?"));
  EXPECT_THAT(message_for("[image]\nfield_of_view = 3"),
              HasSubstr("; did you mean camera.field_of_view?"));
}

TEST(SceneFileAdvice, GuessesNothingFromAWordThatIsLikeNoKey) {
  EXPECT_THAT(message_for(camera + "quaternion = 3"), Not(HasSubstr("did you mean")));
}

TEST(SceneFileAdvice, ListsTheKeysThatThereAre) {
  EXPECT_THAT(message_for("[kernel]\nquaternion = 3"),
              HasSubstr("expected one of width, cut, sampling, min_radius"));
}

TEST(SceneFileAdvice, ReportsTheFirstMistakeOfTheFileFirst) {
  EXPECT_THAT(message_for("tolerance = -1\n[camera]\nfov = 3"), StartsWith("scene.toml:1:"));
  EXPECT_THAT(message_for("[sort]\nbi = 3\n[camera]\nfov = 3"), StartsWith("scene.toml:2:"));
}

TEST(SceneFileAdvice, KeepsLongValuesShort) {
  const std::string message = message_for("tolerance = \"" + std::string(10000, 'x') + "\"");
  EXPECT_LT(message.size(), 200u);
}

}  // namespace
}  // namespace splotchcl
