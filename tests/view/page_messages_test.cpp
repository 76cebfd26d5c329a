// What a page may say, and what is refused.
#include "view/requests/page_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

PageState state_of(const std::string& settings, const std::string& hidden = "[]") {
  return std::get<PageState>(
      parse_page_message(R"({"type":"state","number":7,"moving":true,"settings":)" + settings +
                         R"(,"hidden":)" + hidden + "}"));
}

std::string refusal(const std::string& text) {
  try {
    parse_page_message(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of_setting(const std::string& key, const std::string& value) {
  return refusal(R"({"type":"state","number":1,"moving":false,"hidden":[],"settings":{")" + key +
                 "\":" + value + "}}");
}

TEST(PageMessages, AStateHasSettingsAsToml) {
  const PageState state =
      state_of(R"({"camera.position":[1,2.5,-3e20],"component.12.palette":"magma"})");
  EXPECT_EQ(state.number, 7u);
  EXPECT_TRUE(state.is_moving);
  ASSERT_EQ(state.settings.size(), 2u);
  EXPECT_EQ(state.settings[0].key, "camera.position");
  EXPECT_EQ(state.settings[0].value, "[1, 2.5, -3e+20]");
  EXPECT_EQ(state.settings[1].value, "\"magma\"");
}

TEST(PageMessages, NullLeavesAKeyOpen) {
  const PageState state = state_of(R"({"finish.exposure":null})");
  EXPECT_TRUE(state.settings.empty());
  EXPECT_THAT(state.open, ElementsAre("finish.exposure"));
}

TEST(PageMessages, AStateNamesComponentsThatAreOff) {
  EXPECT_THAT(state_of("{}", "[2,0]").hidden, ElementsAre(0, 2));
}

TEST(PageMessages, AStateMayHaveKeyframesAndAFrameOfTheirFilm) {
  const auto state = std::get<PageState>(parse_page_message(
      R"({"type":"state","number":1,"moving":false,"settings":{},"hidden":[],"frame":12,)"
      R"("keyframes":[{"frame":50,"settings":{"camera.position":[1,2,3]}}]})"));
  EXPECT_EQ(state.frame, 12);
  ASSERT_TRUE(state.keyframes);
  EXPECT_EQ(state.keyframes->at(0).frame, 50);
  EXPECT_EQ(state.keyframes->at(0).values.at("camera.position"), "[1, 2, 3]");
}

TEST(PageMessages, KeyframesWithoutFrameOrSettingsAreRefused) {
  const std::string start =
      R"({"type":"state","number":1,"moving":false,"settings":{},"hidden":[],"keyframes":[)";
  for (const char* const keyframe :
       {"3", "{}", R"({"frame":1})", R"({"frame":-1,"settings":{"tolerance":1}})",
        R"({"frame":1,"settings":{}})", R"({"frame":1,"settings":{"snapshot":"a"}})"})
    EXPECT_NE(refusal(start + keyframe + "]}"), "") << keyframe;
}

TEST(PageMessages, NumbersKeepAllTheirDigits) {
  EXPECT_EQ(state_of(R"({"component.0.color.min":0.1234567890123456})").settings[0].value,
            "0.1234567890123456");
}

TEST(PageMessages, QuestionsHaveTheirId) {
  const auto question = std::get<PageQuestion>(
      parse_page_message(R"({"type":"save_scene","id":3,"path":"a.toml","replace":true})"));
  EXPECT_EQ(question.id, 3u);
  EXPECT_EQ(std::get<SaveScene>(question.what).path, "a.toml");
  EXPECT_TRUE(std::get<SaveScene>(question.what).may_replace);
}

TEST(PageMessages, KeysThatNameFilesAreRefused) {
  for (const char* const key :
       {"snapshot", "component.0.snapshot", "image.background_image", "finish.font", "path.file",
        "component.0.select.ids", "component.x.palette", "component.0", "component..palette"})
    EXPECT_THAT(refusal_of_setting(key, "\"a\""), HasSubstr("none that a page may set")) << key;
}

TEST(PageMessages, ValuesOfAnotherKindAreRefused) {
  EXPECT_NE(refusal_of_setting("camera.position", "3"), "");
  EXPECT_NE(refusal_of_setting("camera.position", "[1]"), "");
  EXPECT_NE(refusal_of_setting("camera.position", "[1,2,3,4]"), "");
  EXPECT_NE(refusal_of_setting("camera.position", R"([1,2,"3"])"), "");
  EXPECT_NE(refusal_of_setting("camera.field_of_view", "1e999"), "");
  EXPECT_NE(refusal_of_setting("component.0.palette", "3"), "");
  EXPECT_NE(refusal_of_setting("finish.scale_bar.show", "1"), "");
}

TEST(PageMessages, WordsCannotBecomeOtherToml) {
  for (const char* const word : {R"("a\"b")", R"("a\nb")", R"("a\\b")", R"("")"})
    EXPECT_THAT(refusal_of_setting("component.0.palette", word), HasSubstr("plain characters"));
}

TEST(PageMessages, WhatIsNoMessageIsRefused) {
  for (const char* const text :
       {"", "x", "[]", "{}", "null", R"({"type":3})", R"({"type":"other","id":1})",
        R"({"type":"state"})", R"({"type":"acknowledge","frame":-1})",
        R"({"type":"pick","id":1,"x":2,"y":0})", R"({"type":"pick","id":1,"x":null,"y":0})",
        R"({"type":"save_scene","id":1,"path":"","replace":false})",
        R"({"type":"histogram","id":1})", "\xff\xfe"})
    EXPECT_NE(refusal(text), "") << text;
}

TEST(PageMessages, HugeAndDeepOnesAreRefused) {
  EXPECT_THAT(refusal(std::string(longest_message_bytes + 1, ' ')), HasSubstr("64 KiB"));
  EXPECT_THAT(refusal(std::string(30000, '[')), HasSubstr("nested"));
}

}  // namespace
}  // namespace splotchcl::view
