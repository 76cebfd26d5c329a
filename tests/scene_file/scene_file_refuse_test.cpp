#include "scene_file/scene_checks.h"
#include "testing.h"
#include "text_rows.h"

namespace splotchcl::test {
namespace {

class RefusedSceneFile : public ::testing::TestWithParam<TextRow> {};

TEST_P(RefusedSceneFile, IsRefusedInOneLineThatSaysWhere) {
  const std::string text = GetParam().texts.front();
  const std::string message = message_for(text.substr(0, text.size() - 1));
  EXPECT_THAT(message, StartsWith(GetParam().expected.front()));
  for (const std::string& part : GetParam().expected)
    EXPECT_THAT(message, HasSubstr(part));
  EXPECT_THAT(message, HasSubstr("expected"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(Rows, RefusedSceneFile,
                         ::testing::ValuesIn(read_text_rows(source_folder() /
                                                            "tests/scene_file/refused.rows")),
                         [](const auto& info) { return info.param.name; });

TEST(SceneFileRefuses, BracketsThatNeverEnd) {
  EXPECT_THAT(message_for("a = " + std::string(100000, '[')),
              AllOf(StartsWith("scene.toml:1: found no valid"), HasSubstr("expected"),
                    Not(HasSubstr("\n"))));
}

TEST(SceneFileAdvice, GuessesNothingFromAWordThatIsLikeNoKey) {
  const std::string camera = "[camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, 1]\n";
  EXPECT_THAT(message_for(camera + "quaternion = 3"),
              AllOf(HasSubstr("quaternion"), Not(HasSubstr("did you mean"))));
}

TEST(SceneFileAdvice, KeepsLongValuesShort) {
  const std::string message = message_for("tolerance = \"" + std::string(10000, 'x') + "\"");
  EXPECT_LT(message.size(), 200u);
}

}  // namespace
}  // namespace splotchcl::test
