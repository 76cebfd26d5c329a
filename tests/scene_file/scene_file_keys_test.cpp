#include "scene_file/keys.h"
#include "scene_file/random_scenes.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

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
  for (const char* name : {"gas.toml", "gas_and_stars.toml", "light_only.toml", "dome.toml",
                           "panorama.toml", "cube.toml", "stereo.toml"}) {
    const Scene scene = read_scene_file(test::source_folder() / "examples" / name);
    EXPECT_FALSE(scene.components.empty()) << name;
    for (const Component& component : scene.components) {
      EXPECT_NO_THROW(load_palette(component.palette)) << name;
    }
  }
}

}  // namespace
}  // namespace splotchcl
