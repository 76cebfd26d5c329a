#include "scene_file/random_scenes.h"
#include "scene_file/scene_checks.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::expect_same;

TEST(FormattedScene, ReadsBackAsTheSameScene) {
  test::RandomScenes scenes(2008);
  for (int i = 0; i < test::rounds(2000) && !::testing::Test::HasFailure(); ++i) {
    const Scene scene = scenes.next();
    const std::string text = format_scene(scene);
    SCOPED_TRACE(text);
    expect_same(parse_scene(text, "scene.toml"), scene);
  }
  // A few scenes may not have all keys that are taken only together.
  const std::size_t keys = scene_file::all_keys().size();
  for (int i = 0; i < 400 && scenes.taken().size() < keys; ++i)
    scenes.next();
  for (const scene_file::Key& key : scene_file::all_keys())
    EXPECT_EQ(scenes.taken().count(key.path), 1U) << key.path << " was in no scene";
}

TEST(FormattedScene, OfWhatWasReadIsTheSameText) {
  test::RandomScenes scenes(612);
  for (int i = 0; i < test::rounds(200); ++i) {
    const std::string text = format_scene(scenes.next());
    EXPECT_EQ(format_scene(parse_scene(text, "scene.toml")), text);
  }
}

TEST(FormattedScene, ReadsLikeOneWrittenByHand) {
  Scene scene;
  scene.snapshot = "snap_006";
  scene.image.width = 640;
  scene.camera.emplace();
  scene.components.emplace_back();
  scene.components[0].name = "gas";
  scene.components[0].color = {"temperature", Scaling::log, 1e4, std::nullopt};
  EXPECT_EQ(format_scene(scene), R"(snapshot = "snap_006"
tolerance = 0.001

[image]
size = [640, 1024]
gamma = 1
background = [0, 0, 0]

[camera]
position = [0, 0, 0]
look_at = [0, 0, 1]
sky = [0, 1, 0]
projection = "perspective"

[kernel]
width = 0.3872983346207417
sampling = "mean"
min_radius = 0

[sort]
by = "depth"
order = "ascending"

[[component]]
name = "gas"
types = ["gas"]
size = { field = "smoothing_length", factor = 1 }
color = { field = "temperature", scaling = "log", min = 10000 }
palette = "inferno"
brightness = 1
absorption = "emission"
)");
}

TEST(FormattedScene, LeavesOutWhatHasNoMeaning) {
  Scene scene;
  scene.components.emplace_back();
  scene.components[0].size_field = "unused beside a fixed size";
  scene.components[0].size_fixed = 2;
  scene.components[0].color.scaling = Scaling::log;  // of no field
  const std::string text = format_scene(scene);
  EXPECT_THAT(text, HasSubstr("size = { fixed = 2, factor = 1 }"));
  EXPECT_THAT(text, Not(HasSubstr("color")));
}

// What no scene file can say is refused, not written as something else.
TEST(FormattedScene, IsRefusedWhereItCouldNotBeReadBack) {
  Scene scene;
  scene.tolerance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(format_scene(scene), UsageError);

  scene = Scene();
  scene.sort = {SortOrder::By::field, "", false};
  EXPECT_THROW(format_scene(scene), UsageError);

  scene = Scene();
  scene.components.resize(1);
  scene.components[0].absorption = {Absorption::Kind::gray, -1};
  EXPECT_THROW(format_scene(scene), UsageError);

  scene = Scene();
  scene.snapshot = "not UTF-8: \xff";
  EXPECT_THROW(format_scene(scene), UsageError);
}

TEST(FormattedScene, NeverTakesAFieldForTheDepth) {
  Scene scene;
  scene.sort = {SortOrder::By::field, "depth", false};
  EXPECT_THROW(format_scene(scene), UsageError);
}

}  // namespace
}  // namespace splotchcl
