// What a page's state makes of the scene that was opened.
#include "view/view_scene.h"

#include "splotchcl/camera.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::view {
namespace {

Scene opened_scene() {
  Scene scene;
  scene.snapshot = "snapshot";
  scene.camera.emplace();
  scene.camera->width = 3;
  scene.components.resize(2);
  for (Component& component : scene.components) {
    component.color.field = "density";
    component.color.minimum = 1;
    component.color.maximum = 2;
  }
  return scene;
}

PageState state_with(const std::string& key, const std::string& value) {
  PageState state;
  state.settings.push_back({key, value});
  return state;
}

TEST(ViewScene, IsTheOpenedOneForAnEmptyState) {
  EXPECT_EQ(format_scene(scene_of(opened_scene(), nullptr, {})), format_scene(opened_scene()));
}

TEST(ViewScene, HasTheStatesSettings) {
  const Scene scene =
      scene_of(opened_scene(), nullptr, state_with("component.1.palette", "\"magma\""));
  EXPECT_EQ(scene.components[1].palette, "magma");
  EXPECT_EQ(scene.components[0].palette, opened_scene().components[0].palette);
}

TEST(ViewScene, AFieldOfViewTakesThePlaceOfAWidth) {
  const Scene scene = scene_of(opened_scene(), nullptr, state_with("camera.field_of_view", "30"));
  EXPECT_FALSE(scene.camera->width);
  EXPECT_EQ(scene.camera->field_of_view_degrees, 30);
}

// As open_scene gives it for a snapshot.
Scene suggested_scene() {
  Scene scene = opened_scene();
  scene.camera->width.reset();
  scene.camera->field_of_view_degrees = 40;
  return scene;
}

TEST(ViewScene, AProjectionOfWideAnglesHasAFieldOfViewOfItsOwnInPlaceOfASuggestedOne) {
  const Scene suggested = suggested_scene();
  for (const auto& [projection, degrees] : {std::pair{"\"cube\"", 90}, {"\"fisheye\"", 180}}) {
    const PageState state = state_with("camera.projection", projection);
    const Scene scene = scene_of(suggested, &suggested, state);
    EXPECT_EQ(field_of_view_degrees(*scene.camera), degrees) << projection;
  }
}

TEST(ViewScene, AProjectionOfWideAnglesKeepsTheFieldOfViewOfASceneFile) {
  const PageState state = state_with("camera.projection", "\"fisheye\"");
  EXPECT_EQ(scene_of(suggested_scene(), nullptr, state).camera->field_of_view_degrees, 40);
}

GivenWay given_way_to(const PageState& state) {
  const Scene suggested = suggested_scene();
  return given_way(suggested, state, scene_of(suggested, &suggested, state));
}

TEST(ViewScene, TellsWhatGaveWayToAPanorama) {
  const GivenWay instead = given_way_to(state_with("camera.projection", "\"equirectangular\""));
  EXPECT_EQ(instead.field_of_view_degrees, 360);
  EXPECT_EQ(instead.size, (std::array{1024, 512}));
}

TEST(ViewScene, NothingGivesWayToWhatTheStateSets) {
  PageState state = state_with("image.size", "[64, 32]");
  state.settings.push_back({"camera.field_of_view", "30"});
  EXPECT_FALSE(given_way_to(state).field_of_view_degrees);
  EXPECT_FALSE(given_way_to(state).size);
}

TEST(ViewScene, LeavesOpenWhatTheStateLeavesOpen) {
  PageState state;
  state.open = {"component.0.color.min", "finish.exposure"};
  const Scene scene = scene_of(opened_scene(), nullptr, state);
  EXPECT_FALSE(scene.components[0].color.minimum);
  EXPECT_TRUE(scene.components[0].color.maximum);
  EXPECT_THAT(open_keys(scene), ElementsAre("component.0.color.min", "finish.exposure"));
}

TEST(ViewScene, AFrameOfTheFilmIsBetweenItsKeyframes) {
  PageState state;
  state.keyframes = {{0, {{"camera.field_of_view", "20"}}}, {10, {{"camera.field_of_view", "40"}}}};
  const Scene scene = scene_of(opened_scene(), nullptr, state);
  EXPECT_EQ(*at_frame(film_of(scene), scene, 0).camera->field_of_view_degrees, 20);
  EXPECT_EQ(*at_frame(film_of(scene), scene, 10).camera->field_of_view_degrees, 40);
  const double between = *at_frame(film_of(scene), scene, 4).camera->field_of_view_degrees;
  EXPECT_GT(between, 20);
  EXPECT_LT(between, 40);
  EXPECT_THROW(at_frame(film_of(scene), scene, 11), UsageError);
}

TEST(ViewScene, LeavesToItsDefaultWhatThePageTakesAway) {
  Scene opened = opened_scene();
  opened.stereo.emplace();
  opened.finish.title.text = "title";
  opened.components[1].select.where = {"density > 1"};
  opened.components[1].select.sphere_center = Vec3{{0, 0, 0}};
  opened.components[1].select.sphere_radius = 3;
  opened.components[1].intensity.field = "density";
  PageState state;
  state.open = {"stereo.layout", "finish.title.text", "component.1.select.where",
                "component.1.select.sphere.radius", "component.1.intensity.field"};
  const Scene scene = scene_of(opened, nullptr, state);
  EXPECT_FALSE(scene.stereo);
  EXPECT_EQ(scene.finish.title.text, "");
  EXPECT_FALSE(scene.components[1].select.is_given());
  EXPECT_EQ(scene.components[1].intensity.field, "");
}

TEST(ViewScene, ComponentsThatAreAddedHaveNamesOfTheirOwn) {
  Component halo;
  halo.name = "halo";
  const Scene scene = with_components(opened_scene(), {halo, halo});
  ASSERT_EQ(scene.components.size(), 4u);
  EXPECT_EQ(scene.components[2].name, "halo");
  EXPECT_EQ(scene.components[3].name, "halo 2");
}

TEST(ViewScene, KeyframesOfTheCameraTakeThePlaceOfAnotherPath) {
  Scene opened = opened_scene();
  opened.path.orbit.emplace();
  opened.movie.frames = 250;
  PageState state;
  state.keyframes = {{0, {{"component.0.brightness", "1"}}}};
  EXPECT_TRUE(scene_of(opened, nullptr, state).path.orbit);
  state.keyframes->push_back({5, {{"camera.field_of_view", "20"}}});
  EXPECT_FALSE(scene_of(opened, nullptr, state).path.orbit);
  EXPECT_FALSE(scene_of(opened, nullptr, state).movie.frames);
}

TEST(ViewScene, KeyframesFollowTheComponentsThatStay) {
  Scene scene = opened_scene();
  scene.path.keyframes = {{0, {{"component.0.brightness", "1"}, {"component.1.brightness", "2"}}},
                          {5, {{"component.0.brightness", "3"}}}};
  const Scene shown = without_hidden(scene, {0});
  ASSERT_EQ(shown.path.keyframes.size(), 1u);
  EXPECT_THAT(shown.path.keyframes[0].values, ElementsAre(std::pair<const std::string, std::string>(
                                                  "component.0.brightness", "2")));
}

TEST(ViewScene, OtherKeysCannotBeOpen) {
  PageState state;
  state.open = {"camera.position"};
  EXPECT_THROW(scene_of(opened_scene(), nullptr, state), UsageError);
}

TEST(ViewScene, TellsTheNumbersThatWereFound) {
  const auto numbers = numbers_of(opened_scene(), {"component.1.color.max", "finish.white"});
  EXPECT_EQ(numbers.at("component.1.color.max"), 2);
  EXPECT_EQ(numbers.at("finish.white"), 1);
}

TEST(ViewScene, ValuesThatNoSceneCanHaveAreRefused) {
  EXPECT_THROW(scene_of(opened_scene(), nullptr, state_with("camera.field_of_view", "-3")),
               UsageError);
  EXPECT_THROW(scene_of(opened_scene(), nullptr, state_with("component.2.palette", "\"magma\"")),
               UsageError);
}

TEST(ViewScene, PalettesAreNoFiles) {
  EXPECT_NO_THROW(
      scene_of(opened_scene(), nullptr, state_with("component.0.palette", "\"magma_r\"")));
  EXPECT_THROW(
      scene_of(opened_scene(), nullptr, state_with("component.0.palette", "\"/etc/passwd\"")),
      UsageError);
}

// With another name in a keyframe than at the start.
PageState state_with_keyframe(const std::string& key, const std::string& value) {
  PageState state;
  state.keyframes = {{0, {{key, "\"magma\""}}}, {2, {{key, value}}}};
  return state;
}

TEST(ViewScene, PalettesOfKeyframesAreNoFiles) {
  const std::string key = "component.0.palette";
  EXPECT_NO_THROW(scene_of(opened_scene(), nullptr, state_with_keyframe(key, "\"viridis_r\"")));
  for (const char* const name : {"\"/etc/passwd\"", "\"../secret\"", "\"secret.txt\"", "\"secret\"",
                                 "/etc/passwd", "'/etc/passwd'"}) {
    EXPECT_THROW(scene_of(opened_scene(), nullptr, state_with_keyframe(key, name)), UsageError)
        << name;
    EXPECT_THROW(scene_of(opened_scene(), nullptr,
                          state_with_keyframe("component.1.absorption_palette", name)),
                 UsageError)
        << name;
  }
}

TEST(ViewScene, FilesOfAnyKeyOfKeyframesAreRefused) {
  for (const char* const key : {"snapshot", "image.background_image", "finish.font",
                                "finish.cross_fade.scene", "component.0.select.ids"}) {
    PageState state;
    state.keyframes = {{0, {{key, "\"/etc/passwd\""}}}};
    EXPECT_THROW(scene_of(opened_scene(), nullptr, state), UsageError) << key;
  }
}

TEST(ViewScene, KeepsFilesThatTheOpenedScenesOwnKeyframesName) {
  Scene opened = opened_scene();
  opened.path.keyframes = {{0, {{"component.0.palette", "\"own/palette.txt\""}}}};
  EXPECT_NO_THROW(scene_of(opened, nullptr, {}));
  EXPECT_NO_THROW(
      scene_of(opened, nullptr, state_with_keyframe("component.0.palette", "\"own/palette.txt\"")));
}

TEST(ViewScene, HugePicturesAreRefused) {
  EXPECT_THROW(scene_of(opened_scene(), nullptr, state_with("image.size", "[65536, 65536]")),
               UsageError);
}

TEST(ViewScene, ComponentsThatAreOffAreLeftOut) {
  Scene scene = opened_scene();
  scene.components[1].name = "stars";
  EXPECT_EQ(without_hidden(scene, {0}).components.at(0).name, "stars");
  EXPECT_EQ(without_hidden(scene, {0}).components.size(), 1u);
  EXPECT_THROW(without_hidden(scene, {0, 1}), UsageError);
}

}  // namespace
}  // namespace splotchcl::view
