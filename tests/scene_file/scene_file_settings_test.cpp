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

TEST(Settings, OverrideTheFile) {
  EXPECT_EQ(with({"tolerance=0.5"}).tolerance, 0.5);
  EXPECT_EQ(with({"camera.field_of_view=30"}).camera->field_of_view_degrees, 30);
  EXPECT_EQ(with({"snapshot=other"}).snapshot, "other");
}

TEST(Settings, MoveTheCameraToACenterWithoutTurningIt) {
  const Camera camera = *with({"camera.center=[1,2,3]", "camera.width=5"}).camera;
  EXPECT_TRUE(same(camera.look_at, {{1, 2, 3}}));
  EXPECT_TRUE(same(camera.position, {{1, 2, -7}}));
  EXPECT_EQ(camera.width, 5);
  EXPECT_FALSE(camera.center);
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

TEST(Settings, AddressComponentsByNumberAndByName) {
  EXPECT_EQ(with({"component.0.palette=magma"}).components[0].palette, "magma");
  EXPECT_EQ(with({"component.gas.palette=magma"}).components[0].palette, "magma");
  EXPECT_EQ(with({"component.1.brightness=3"}).components[1].brightness, 3);
  EXPECT_EQ(with({"component.dark.matter.palette=halo"}).components[2].palette, "halo");
}

TEST(Settings, TakeTomlValues) {
  EXPECT_TRUE(same(with({"camera.sky=[0, 1.5, 2]"}).camera->sky, {{0, 1.5, 2}}));
  EXPECT_EQ(with({"snapshot=\"a = b\""}).snapshot, "a = b");
  EXPECT_THAT(with({"component.1.types=[0, \"stars\"]"}).components[1].types, ElementsAre(0, 4));
}

TEST(Settings, TakeBareWordsForStrings) {
  EXPECT_EQ(with({"sort.order=descending"}).sort.descending, true);
  EXPECT_EQ(with({"snapshot=data/snap_092.0.hdf5"}).snapshot, "data/snap_092.0.hdf5");
  EXPECT_EQ(with({"snapshot=a=b"}).snapshot, "a=b");
}

TEST(Settings, TakeWhatLooksLikeANumberForAStringWhereOneIsExpected) {
  EXPECT_EQ(with({"snapshot=092"}).snapshot, "092");
  EXPECT_EQ(with({"snapshot=92"}).snapshot, "92");
  EXPECT_EQ(with({"component.gas.name=2024-01-01"}).components[0].name, "2024-01-01");
  EXPECT_EQ(with({"component.gas.color.field=true"}).components[0].color.field, "true");
}

TEST(Settings, MayHaveSpacesAroundKeyAndValue) {
  EXPECT_EQ(with({" tolerance = 0.5 "}).tolerance, 0.5);
  EXPECT_EQ(with({" snapshot = a file "}).snapshot, "a file");
}

TEST(Settings, TakeTables) {
  const Scene scene = with({"component.gas.color={field=\"U\", min=1}"});
  EXPECT_EQ(scene.components[0].color.field, "U");
  EXPECT_EQ(scene.components[0].color.minimum, 1);
}

TEST(Settings, MayDependOnEachOtherInAnyOrder) {
  expect_same(with({"component.0.color.min=1", "component.0.color.field=U"}),
              with({"component.0.color.field=U", "component.0.color.min=1"}));
}

TEST(Settings, TakeFogForTheEndOfLight) {
  const Scene scene =
      with({"camera.position=[0,0,-1]", "camera.look_at=[0,0,0]", "camera.fog=[20,50]"});
  EXPECT_EQ(scene.camera->far_limit, 50);
  EXPECT_EQ(scene.camera->fade.far_length, 30);
}

TEST(Settings, ReplaceWhatExcludesThem) {
  EXPECT_FALSE(with({"component.1.size.field=HSML"}).components[1].size_fixed);
  EXPECT_EQ(with({"component.0.size.fixed=3"}).components[0].size_fixed, 3);
  EXPECT_EQ(with({"component.1.absorption=none"}).components[1].absorption.kind,
            Absorption::Kind::none);
  EXPECT_EQ(with({"image.width=7"}).image.width, 7);
}

TEST(Settings, MayBringTheCamera) {
  const Scene scene =
      parse_scene("", "scene.toml", {"camera.position=[0,0,1]", "camera.look_at=[0,0,2]"});
  ASSERT_TRUE(scene.camera);
  EXPECT_TRUE(same(scene.camera->look_at, {{0, 0, 2}}));
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

FieldMap color_of(const std::string& color, const std::vector<std::string>& settings) {
  return parse_scene("[[component]]\ncolor = { field = 'U', " + color + " }\n", "scene.toml",
                     settings)
      .components[0]
      .color;
}

TEST(SettingsOfPercentiles, ReplaceARangeOfTwoLimits) {
  const FieldMap color = color_of("min = 1, max = 2", {"component.0.color.percentiles=[20,80]"});
  EXPECT_FALSE(color.minimum);
  EXPECT_FALSE(color.maximum);
  EXPECT_EQ(color.percentiles, (std::array<double, 2>{20, 80}));
}

TEST(SettingsOfPercentiles, KeepALimitBesideAMissingOne) {
  EXPECT_EQ(color_of("min = 1", {"component.0.color.percentiles=[20,80]"}).minimum, 1);
  const FieldMap color = color_of(
      "min = 1, max = 2", {"component.0.color.percentiles=[20,80]", "component.0.color.max=3"});
  EXPECT_FALSE(color.minimum);
  EXPECT_EQ(color.maximum, 3);
}

TEST(SettingsOfARange, ReplacePercentiles) {
  const FieldMap color =
      color_of("percentiles = [20, 80]", {"component.0.color.min=1", "component.0.color.max=2"});
  EXPECT_EQ(color.minimum, 1);
  EXPECT_EQ(color.maximum, 2);
  EXPECT_FALSE(color.percentiles);
}

TEST(SettingsOfARange, OfAMapAndItsPercentilesReplaceEachOther) {
  const std::string limits = "[map]\nmin = 1\nmax = 2\n",
                    percents = "[map]\npercentiles = [20, 80]\n";
  const MapSettings by_percentiles =
      parse_scene(limits, "scene.toml", {"map.percentiles=[20,80]"}).map;
  EXPECT_FALSE(by_percentiles.minimum);
  EXPECT_FALSE(by_percentiles.maximum);
  const MapSettings by_limits = parse_scene(percents, "scene.toml", {"map.min=1", "map.max=2"}).map;
  EXPECT_FALSE(by_limits.percentiles);
  EXPECT_EQ(by_limits.maximum, 2);
}

TEST(SettingsOfColors, OfTheParticlesReplaceAField) {
  const Component component =
      parse_scene("[[component]]\ncolor = { field = 'U', scaling = 'log', min = 1, max = 2 }\n",
                  "scene.toml", {"component.0.color.vector=velocity"})
          .components[0];
  EXPECT_EQ(component.color_vector, "velocity");
  EXPECT_EQ(component.color.field, "");
}

TEST(SettingsOfColors, OfAFieldReplaceThoseOfTheParticles) {
  const Component component = parse_scene("[[component]]\ncolor.vector = 'Color'\n", "scene.toml",
                                          {"component.0.color.field=density"})
                                  .components[0];
  EXPECT_EQ(component.color_vector, "");
  EXPECT_EQ(component.color.field, "density");
}

TEST(SettingsOfColors, KeepAFieldThatIsLookedUpInAnAbsorptionPalette) {
  const Component component =
      parse_scene("[[component]]\nabsorption_palette = 'gray'\ncolor.field = 'U'\n", "scene.toml",
                  {"component.0.color.vector=Color"})
          .components[0];
  EXPECT_EQ(component.color_vector, "Color");
  EXPECT_EQ(component.color.field, "U");
}

// As it is chosen for a snapshot: the range was found in the data of the field.
Scene suggested() {
  Scene scene;
  scene.components.resize(1);
  scene.components[0].color = {"internal_energy", Scaling::log, 0.5, 2e5};
  return scene;
}

FieldMap color_with(const std::vector<std::string>& settings) {
  const Scene scene = suggested();
  return scene_file::apply_settings_to_suggested(scene, &scene, settings).components[0].color;
}

TEST(SettingsOfASuggestedScene, LeaveTheRangeOfAnotherFieldToTheData) {
  for (const char* setting :
       {"component.0.color.field=density", "component.0.color={field=\"density\"}"}) {
    const FieldMap color = color_with({setting});
    EXPECT_EQ(color.field, "density");
    EXPECT_EQ(color.scaling, Scaling::log);
    EXPECT_FALSE(color.minimum);
    EXPECT_FALSE(color.maximum);
  }
}

TEST(SettingsOfASuggestedScene, KeepALimitThatIsGivenWithTheField) {
  const FieldMap color =
      color_with({"component.0.color.field=density", "component.0.color.min=1e-9"});
  EXPECT_EQ(color.minimum, 1e-9);
  EXPECT_FALSE(color.maximum);
}

TEST(SettingsOfASuggestedScene, KeepALimitThatWasGivenBeforeTheField) {
  const Scene first = suggested();
  const Scene before = apply_settings(first, {"component.0.color.min=3"});
  const Scene after =
      scene_file::apply_settings_to_suggested(before, &first, {"component.0.color.field=density"});
  EXPECT_EQ(after.components[0].color.minimum, 3);
  EXPECT_FALSE(after.components[0].color.maximum);
}

TEST(SettingsOfASuggestedScene, KeepTheRangeOfTheSameField) {
  const FieldMap color =
      color_with({"component.0.color.field=internal_energy", "component.0.color.scaling=linear"});
  EXPECT_EQ(color.minimum, 0.5);
  EXPECT_EQ(color.maximum, 2e5);
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

TEST(SettingsOfASuggestedScene, KeepAFieldOfViewThatIsGivenWithTheProjection) {
  const Camera camera = camera_with({"camera.field_of_view=120", "camera.projection=fisheye"});
  EXPECT_EQ(camera.field_of_view_degrees, 120);
}

TEST(SettingsOfASuggestedScene, KeepTheFramingWithoutPerspective) {
  EXPECT_EQ(camera_with({"camera.projection=orthographic"}).field_of_view_degrees, 40);
}

TEST(SettingsOfASuggestedScene, TurnTheSkyWhereTheCameraLooksAlongIt) {
  const auto sky = [](const char* position) {
    return camera_with({position, "camera.look_at=[0, 0, 0]"}).sky;
  };
  EXPECT_TRUE(same(sky("camera.position=[0, 9, 0]"), {{0, 0, 1}}));
  EXPECT_TRUE(same(sky("camera.position=[0, 9, 1]"), {{0, 1, 0}}));
}

double bloom_with(const std::vector<std::string>& settings) {
  Scene scene;
  scene.camera.emplace();
  scene.finish.bloom = 0.1;
  return scene_file::apply_settings_to_suggested(scene, &scene, settings).finish.bloom;
}

TEST(SettingsOfASuggestedScene, StopTheGlowAtTheSeamsOfPanoramasAndCubes) {
  EXPECT_EQ(bloom_with({}), 0.1);
  EXPECT_EQ(bloom_with({"camera.projection=fisheye"}), 0.1);
  EXPECT_EQ(bloom_with({"camera.projection=cube"}), 0);
  EXPECT_EQ(bloom_with({"camera.projection=equirectangular"}), 0);
  EXPECT_THROW(bloom_with({"camera.projection=cube", "finish.bloom=0.2"}), UsageError);
}

std::pair<int, int> size_of_panorama_with(std::vector<std::string> settings) {
  settings.emplace_back("camera.projection=equirectangular");
  Scene scene;
  scene.camera.emplace();
  const Scene panorama = scene_file::apply_settings_to_suggested(scene, &scene, settings);
  return {panorama.image.width, panorama.image.height};
}

TEST(SettingsOfASuggestedScene, MakeAPanoramaTwiceAsWideAsHigh) {
  EXPECT_EQ(size_of_panorama_with({}), std::pair(1024, 512));
  EXPECT_EQ(size_of_panorama_with({"image.width=2001"}), std::pair(2001, 1000));
  EXPECT_EQ(size_of_panorama_with({"image.height=1000"}), std::pair(2000, 1000));
}

TEST(SettingsOfASuggestedScene, LeaveAPartOfAPanoramaAsHighAsItMayBe) {
  EXPECT_EQ(size_of_panorama_with({"camera.field_of_view=90"}), std::pair(1024, 1024));
  EXPECT_EQ(size_of_panorama_with({"camera.field_of_view=240"}), std::pair(1024, 768));
}

TEST(SettingsOfASuggestedScene, KeepASizeThatIsGivenForAPanorama) {
  EXPECT_EQ(size_of_panorama_with({"image.size=[300,100]"}), std::pair(300, 100));
  EXPECT_THROW(size_of_panorama_with({"image.size=[100,100]"}), UsageError);
}

TEST(SettingsOfASceneFile, KeepTheLimitsOfTheFile) {
  const Scene scene = parse_scene("[[component]]\ncolor = { field = 'U', min = 1, max = 2 }\n",
                                  "scene.toml", {"component.0.color.field=density"});
  EXPECT_EQ(scene.components[0].color.minimum, 1);
  EXPECT_EQ(scene.components[0].color.maximum, 2);
}

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
