#include "scene_file/random_scenes.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl {
namespace {

// Whether a text is refused, which is to be in one line.
bool is_refused(const std::string& text) {
  try {
    parse_scene(text, "scene.toml");
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.rfind("scene.toml", 0), 0u) << message;
    return true;
  }
  return false;
}

// Whatever the text, it is a scene or it is refused; any other exception, and any crash, fails the
// test.
void expect_scene_or_message(const std::string& text) {
  is_refused(text);
}

class DamagedSceneFiles : public ::testing::Test {
 protected:
  std::size_t below(std::size_t size) {
    return std::uniform_int_distribution<std::size_t>(0, size - 1)(random_);
  }
  char letter() {
    // The last of these are no UTF-8.
    static constexpr char letters[] = "=[]{}\"'.,#\n\r\t -+_0123456789eEnaif\\u\0\x80\xc3\xff";
    return letters[below(sizeof(letters) - 1)];
  }
  std::mt19937 random_{1};
};

std::string deep_key(std::size_t parts) {
  std::string key = "a";
  for (std::size_t i = 1; i < parts; ++i)
    key += ".a";
  return key;
}

// A table inside a table for each part: all of them once ran out of stack.
TEST(DeepKeys, AreRefusedWhateverTheirDepth) {
  for (const std::size_t parts : {20U, 1000U, 200000U}) {
    const std::string key = deep_key(parts);
    for (const std::string& text :
         {key + " = 1", "[" + key + "]", "[[" + key + "]]", "camera = { " + key + " = 1 }",
          "title = '''\n'''\n'a' . \"b\\\"\" ." + key + " = 1"}) {
      EXPECT_TRUE(is_refused(text)) << parts;
    }
    EXPECT_THROW(apply_settings(Scene(), {"image.size={" + key + "=1}"}), UsageError);
    EXPECT_THROW(apply_settings(Scene(), {key + "=1"}), UsageError);
  }
}

TEST(DeepKeys, AreNotDotsInTextsRemarksAndNumbers) {
  const std::string dots(100, '.');
  const Scene scene =
      parse_scene("# " + dots + "\nsnapshot = 'x'\n[finish.title]\ntext = \"" + dots +
                      "\"\n[path.fly]\nthrough = [[1.5, 2.5, 3.5], [1.5, 2.5, 3.5], "
                      "[1.5, 2.5, 3.5], [1.5, 2.5, 3.5], [1.5, 2.5, 3.5]]\n",
                  "scene.toml");
  EXPECT_EQ(scene.finish.title.text, dots);
}

TEST(LongScenes, HaveLimitsOnTextsAndComponents) {
  const auto message = [](const std::string& text) -> std::string {
    return test::refusal_by<UsageError>([&] { parse_scene(text, "scene.toml"); });
  };
  const std::string title = "snapshot = 'x'\n[finish.title]\ntext = \"";
  EXPECT_THAT(message(title + std::string(2000000, 'm') + "\"\n"), HasSubstr("at most 2000 bytes"));
  std::string lines;
  for (int i = 0; i < 60; ++i)
    lines += "m\\n";
  EXPECT_THAT(message(title + lines + "\"\n"), HasSubstr("50 lines"));
  std::string components = "snapshot = 'x'\n";
  for (int i = 0; i < 5000; ++i)
    components += "[[component]]\n";
  EXPECT_THAT(message(components), HasSubstr("at most 1000"));
}

TEST_F(DamagedSceneFiles, AreReadOrRefusedWhenTruncated) {
  test::RandomScenes scenes(3);
  for (int i = 0; i < test::rounds(20); ++i) {
    const std::string text = format_scene(scenes.next());
    for (std::size_t size = 0; size < text.size(); size += 7) {
      expect_scene_or_message(text.substr(0, size));
    }
  }
}

TEST_F(DamagedSceneFiles, AreReadOrRefusedWhenLettersChange) {
  test::RandomScenes scenes(4);
  for (int i = 0; i < test::rounds(2000); ++i) {
    std::string text = format_scene(scenes.next());
    const std::size_t changes = 1 + below(4);
    for (std::size_t change = 0; change < changes; ++change)
      text[below(text.size())] = letter();
    expect_scene_or_message(text);
  }
}

TEST_F(DamagedSceneFiles, AreReadOrRefusedWhenPartsMove) {
  test::RandomScenes scenes(5);
  for (int i = 0; i < test::rounds(1000); ++i) {
    std::string text = format_scene(scenes.next());
    const std::string part = text.substr(below(text.size()), below(60));
    text.insert(below(text.size()), part);
    expect_scene_or_message(text);
  }
}

TEST_F(DamagedSceneFiles, AreReadOrRefusedWhenTheyAreNoise) {
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    const std::size_t size = below(60);
    for (std::size_t k = 0; k < size; ++k)
      text += letter();
    expect_scene_or_message(text);
  }
}

TEST_F(DamagedSceneFiles, AreReadOrRefusedWhenSettingsAreNoise) {
  const Scene scene = test::RandomScenes(6).next();
  for (int i = 0; i < 2000; ++i) {
    std::string setting = "component.0.";
    const std::size_t size = below(20);
    for (std::size_t k = 0; k < size; ++k)
      setting += letter();
    EXPECT_THROW(apply_settings(scene, {setting}), UsageError) << setting;
  }
}

}  // namespace
}  // namespace splotchcl
