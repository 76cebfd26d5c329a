// Scenes as text, and the table of keys.
#include "scene_file/keys.h"
#include "scene_file/random_scenes.h"
#include "scene_file/scene_checks.h"
#include "splotchcl/palette_file.h"
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

using scene_file::all_keys;
using scene_file::find_key;
using scene_file::is_table;
using scene_file::Key;

std::string read(const std::string& path) {
  std::ifstream file(test::source_folder() / path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// With every part, so that each key has a place, and with that without which others say nothing.
Scene full_scene() {
  Scene scene;
  scene.camera.emplace();
  scene.stereo.emplace();
  scene.components.emplace_back();
  scene.components[0].color.field = scene.components[0].intensity.field = "U";
  scene.time.pattern = "snap_%03d";
  scene.path.orbit.emplace();
  scene.path.follow.emplace();
  scene.path.approach.emplace();
  scene.movie.motion_blur.emplace();
  scene.path.fly.emplace().through.resize(2);
  return scene;
}

bool exclude_each_other(const Key& a, const Key& b) {
  const auto excludes = [](const Key& key, const Key& other) {
    return std::find(key.excludes.begin(), key.excludes.end(), other.path) != key.excludes.end();
  };
  return excludes(a, b) || excludes(b, a);
}

TEST(SceneKeys, AreAllExplained) {
  for (const Key& key : all_keys()) {
    EXPECT_FALSE(key.expected.empty()) << key.path;
    EXPECT_FALSE(key.meaning.empty()) << key.path;
  }
}

TEST(SceneKeys, HaveADefaultOrSayWhatCountsWithoutThem) {
  const Scene scene = full_scene();
  for (const Key& key : all_keys()) {
    EXPECT_TRUE(!key.absent.empty() || key.get(scene, 0)) << key.path;
  }
}

TEST(SceneKeys, AreNeverTablesAsWell) {
  for (const Key& key : all_keys())
    EXPECT_FALSE(is_table(key.path)) << key.path;
}

TEST(SceneKeys, StandInTheListOnce) {
  std::set<std::string> paths;
  for (const Key& key : all_keys())
    EXPECT_TRUE(paths.insert(key.path).second) << key.path;
}

TEST(SceneKeys, ExcludeOnlyKeysThatExist) {
  for (const Key& key : all_keys()) {
    for (const std::string& excluded : key.excludes)
      EXPECT_NE(find_key(excluded), nullptr);
  }
}

TEST(SceneKeys, SetTheirOwnValueAlone) {
  test::RandomValues values(7);
  for (const Key& key : all_keys()) {
    const std::string value = values.value_of(key);
    const toml::table table = toml::parse("value = " + value);
    Scene scene = full_scene();
    ASSERT_TRUE(key.set(scene, 0, *table.get("value"))) << key.path << " = " << value;
    for (const Key& other : all_keys()) {
      if (other.path == key.path || exclude_each_other(key, other)) continue;
      EXPECT_EQ(other.get(scene, 0), other.get(full_scene(), 0)) << key.path << ", " << other.path;
    }
  }
}

TEST(SceneKeys, RefuseValuesOfNoType) {
  const toml::table nested = toml::parse("value = { no = { key = 'takes' } }");
  for (const Key& key : all_keys()) {
    Scene scene = full_scene();
    EXPECT_FALSE(key.set(scene, 0, *nested.get("value"))) << key.path;
  }
}

// The reference in docs/scene.md is made from the list of keys. When this fails, put the
// text that is expected between the page's two marks.
TEST(SceneDocumentation, HoldsTheReferenceOfAllKeysAsItIs) {
  const std::string page = read("docs/scene.md");
  const std::string begin = "<!-- keys -->\n\n", end = "<!-- end of keys -->";
  const std::size_t first = page.find(begin), last = page.find(end);
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(last, std::string::npos);
  EXPECT_EQ(page.substr(first + begin.size(), last - first - begin.size()),
            scene_file::key_reference());
}

TEST(SceneDocumentation, ShowsAnExampleAsItIs) {
  const std::string example = read("examples/gas_and_stars.toml");
  ASSERT_FALSE(example.empty());
  EXPECT_THAT(read("docs/scene.md"), HasSubstr("```toml\n" + example + "```"));
}

TEST(Examples, AreScenesWithPalettesThatExist) {
  const std::map<const char*, std::size_t> components = {
      {"gas.toml", 1},    {"gas_and_stars.toml", 1}, {"light_only.toml", 1},
      {"dome.toml", 1},   {"panorama.toml", 1},      {"cube.toml", 1},
      {"stereo.toml", 1}, {"cluster.toml", 3},       {"planted_galaxy.toml", 3}};
  for (const auto& [name, least] : components) {
    const Scene scene = read_scene_file(test::source_folder() / "examples" / name);
    EXPECT_GE(scene.components.size(), least) << name;
    for (const Component& component : scene.components) {
      EXPECT_NO_THROW(load_palette(component.palette)) << name;
    }
  }
}

}  // namespace
}  // namespace splotchcl
