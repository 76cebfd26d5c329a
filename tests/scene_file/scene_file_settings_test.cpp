#include "scene_file/scene_checks.h"
#include "scene_file/suggested.h"
#include "splotchcl/scene_file.h"
#include "testing.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

const std::string text = R"(
snapshot = "snap"
[image]
size = [100, 50]
[camera]
position = [0, 0, -10]
look_at = [0, 0, 0]
[[component]]
name = "gas"
palette = "gas"
[[component]]
types = 4
size = { fixed = 2 }
gray_absorption = 0.2
[[component]]
name = "dark.matter"
types = 1
)";

Scene with(const std::vector<std::string>& settings) {
  return parse_scene(text, "scene.toml", settings);
}

TEST(Settings, OfWhichThereAreNoneLeaveTheScene) {
  expect_same(with({}), parse_scene(text, "scene.toml"));
}

TEST(Settings, LookFromAboveWhereACameraHasNoPlaceButACenter) {
  const Camera camera =
      *parse_scene("snapshot = 'a'\n[camera]\ncenter = [1, 2, 3]\nwidth = 10\n", "s.toml").camera;
  EXPECT_TRUE(same(camera.look_at, {{1, 2, 3}}));
  EXPECT_EQ(camera.position.a[0], 1);
  EXPECT_GT(camera.position.a[2], 3);
  EXPECT_TRUE(same(camera.sky, {{0, 1, 0}}));
}

TEST(Settings, ChangeNothingElse) {
  Scene expected = with({});
  expected.image.width = 640;
  expected.image.height = 480;
  expect_same(with({"image.size=[640,480]"}), expected);
}

TEST(Settings, MayDependOnEachOtherInAnyOrder) {
  expect_same(with({"component.0.color.min=1", "component.0.color.field=U"}),
              with({"component.0.color.field=U", "component.0.color.min=1"}));
}

TEST(Settings, ApplyToASceneThatCameFromElsewhere) {
  Scene scene;
  scene.components.resize(2);
  scene.components[1].name = "stars";
  const Scene changed = apply_settings(scene, {"component.stars.brightness=2", "image.gamma=2.2"});
  EXPECT_EQ(changed.components[1].brightness, 2);
  EXPECT_EQ(changed.image.gamma, 2.2);
  EXPECT_EQ(scene.components[1].brightness, 1);
}

// As it is chosen for a snapshot: the range was found in the data of the field.
Scene suggested() {
  Scene scene;
  scene.components.resize(1);
  scene.components[0].color = {"internal_energy", Scaling::log, 0.5, 2e5};
  return scene;
}

TEST(SettingsOfASuggestedScene, KeepALimitThatWasGivenBeforeTheField) {
  const Scene first = suggested();
  const Scene before = apply_settings(first, {"component.0.color.min=3"});
  const Scene after =
      scene_file::apply_settings_to_suggested(before, &first, {"component.0.color.field=density"});
  EXPECT_EQ(after.components[0].color.minimum, 3);
  EXPECT_FALSE(after.components[0].color.maximum);
}

Camera camera_with(const std::vector<std::string>& settings) {
  Scene scene;
  scene.camera.emplace();
  scene.camera->field_of_view_degrees = 40;
  return *scene_file::apply_settings_to_suggested(scene, &scene, settings).camera;
}

TEST(SettingsOfASuggestedScene, LeaveTheFieldOfViewToAProjectionOfWideAngles) {
  EXPECT_EQ(field_of_view_degrees(camera_with({"camera.projection=fisheye"})), 180);
  EXPECT_EQ(field_of_view_degrees(
                camera_with({"camera.projection=equirectangular", "image.size=[64,32]"})),
            360);
  EXPECT_EQ(field_of_view_degrees(camera_with({"camera={projection=\"cube\"}"})), 90);
}

class SetScene : public ::testing::TestWithParam<TextRow> {};

TEST_P(SetScene, HasTheValuesOfItsSettings) {
  std::vector<std::string> settings, expected;
  bool is_suggested = false;
  for (const std::string& part : GetParam().expected) {
    if (part == "as suggested") {
      is_suggested = true;
    } else if (part.rfind("with ", 0) == 0) {
      settings.push_back(part.substr(5));
    } else {
      ASSERT_TRUE(part.find(" is ") != std::string::npos || part.rfind("refused ", 0) == 0) << part;
      expected.push_back(part);
    }
  }
  ASSERT_FALSE(expected.empty());
  Scene scene;
  const std::string refused = refusal_by<UsageError>([&] {
    const Scene read = parse_scene(GetParam().texts.front(), "scene.toml");
    scene = is_suggested ? scene_file::apply_settings_to_suggested(read, &read, settings)
                         : parse_scene(GetParam().texts.front(), "scene.toml", settings);
  });
  for (const std::string& part : expected) {
    const std::size_t is = part.find(" is ");
    if (part.rfind("refused ", 0) == 0) {
      EXPECT_THAT(refused, HasSubstr(part.substr(8)));
    } else {
      ASSERT_EQ(refused, "");
      EXPECT_EQ(value_of(scene, part.substr(0, is)), part.substr(is + 4)) << part;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, SetScene,
                         ::testing::ValuesIn(read_text_rows(source_folder() /
                                                            "tests/scene_file/settings.rows")),
                         [](const auto& info) { return info.param.name; });

class RefusedSettings : public ::testing::TestWithParam<TextRow> {};

// A setting in each line.
TEST_P(RefusedSettings, AreNamedInOneLine) {
  std::vector<std::string> settings;
  std::istringstream lines(GetParam().texts.front());
  for (std::string line; std::getline(lines, line);)
    settings.push_back(line);
  const std::string message = message_for(text, settings);
  EXPECT_THAT(message, StartsWith("setting \""));
  EXPECT_THAT(message, HasSubstr("expected"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  for (const std::string& part : GetParam().expected)
    EXPECT_THAT(message, HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, RefusedSettings,
    ::testing::ValuesIn(read_text_rows(source_folder() / "tests/scene_file/refused_settings.rows")),
    [](const auto& info) { return info.param.name; });

TEST(Settings, OfNothingOrOfSeveralLinesAreRefusedInOne) {
  const std::map<std::string, std::string> refused = {
      {"", "found no key with a value"},
      {"tolerance=1\nsnapshot = 2", "key tolerance: found string"},
      {"to\nler=1", "key to ler: found an unknown key"}};
  for (const auto& [setting, message] : refused) {
    EXPECT_THAT(message_for(text, {setting}), AllOf(StartsWith("setting \""), HasSubstr(message),
                                                    HasSubstr("expected"), Not(HasSubstr("\n"))));
  }
}

TEST(Settings, AreNamedWhereOneSideOfThePictureDoesNotFit) {
  const std::string panorama =
      "[image]\nsize = [2048, 1024]\n[camera]\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\n"
      "projection = \"equirectangular\"\n[[component]]\n";
  EXPECT_THAT(message_for(panorama, {"image.width=256"}),
              HasSubstr("setting \"image.width=256\": key image.width: found 256 x 1024"));
}

TEST(Settings, FindNoComponentInASceneWithoutAny) {
  EXPECT_THAT(message_for("", {"component.0.palette=magma"}),
              HasSubstr("expected a scene that has components"));
}

TEST(Settings, AreRefusedInsideACameraThatIsNotThere) {
  EXPECT_THAT(message_for("", {"camera.field_of_view=30"}),
              HasSubstr("key camera.position: found nothing"));
}

}  // namespace
}  // namespace splotchcl::test
