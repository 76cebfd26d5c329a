#include "view/requests/page_messages.h"

#include "matches.h"
#include "testing.h"
#include "view/requests/page_requests.h"

namespace splotchcl::view {
namespace {

// What a page may say, and what is refused.

PageState state_of(const std::string& settings, const std::string& hidden = "[]") {
  return std::get<PageState>(
      parse_page_message(R"({"type":"state","number":7,"moving":true,"settings":)" + settings +
                         R"(,"hidden":)" + hidden + "}"));
}

std::string refusal(const std::string& text) {
  return test::refusal_by<UsageError>([&] { parse_page_message(text); });
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

TEST(PageMessages, KeyframesMaySlowDownAndStay) {
  const auto state = std::get<PageState>(parse_page_message(
      R"({"type":"state","number":1,"moving":false,"settings":{},"hidden":[],"keyframes":)"
      R"([{"frame":5,"settings":{"component.0.brightness":2},"ease":true,"dwell":25}]})"));
  EXPECT_TRUE(state.keyframes->at(0).is_eased);
  EXPECT_EQ(state.keyframes->at(0).dwell, 25);
}

TEST(PageMessages, AStateMayHaveComponentsForOtherParticles) {
  const std::string start =
      R"({"type":"state","number":1,"moving":false,"settings":{},"hidden":[],"added":)";
  const auto state = std::get<PageState>(parse_page_message(start + R"(["halo","halo"]})"));
  EXPECT_THAT(state.added, ElementsAre("halo", "halo"));
  for (const char* const added : {"3}", R"(["halo",3]})", R"([""]})"})
    EXPECT_NE(refusal(start + added), "") << added;
}

TEST(PageMessages, FilmsAreMadeAndCancelled) {
  const auto question = std::get<PageQuestion>(
      parse_page_message(R"({"type":"make_film","id":3,"path":"a.mp4","replace":false})"));
  EXPECT_EQ(std::get<MakeFilm>(question.what).path, "a.mp4");
  EXPECT_TRUE(std::holds_alternative<CancelFilm>(parse_page_message(R"({"type":"cancel_film"})")));
}

TEST(PageMessages, KeysThatMayBeSetAreOfEachComponent) {
  EXPECT_THAT(settable_keys(2), Contains("component.1.color.field"));
  EXPECT_TRUE(is_settable("component.7.select.where"));
  EXPECT_FALSE(is_settable("component.7.select.ids"));
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

TEST(PageMessages, TextsMayHaveQuotesAndStayOneString) {
  EXPECT_EQ(state_of(R"({"finish.title.text":"a \"b\" \\ c"})").settings[0].value,
            R"("a \"b\" \\ c")");
  EXPECT_NE(refusal_of_setting("finish.title.text", R"("a\nb = 1")"), "");
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
  EXPECT_THAT(refusal(std::string(longest_message_bytes + 1, ' ')), HasSubstr("256 KiB"));
  EXPECT_THAT(refusal(std::string(30000, '[')), HasSubstr("nested"));
}

// The files of the page are in the program.

TEST(PageFiles, ThePageItselfHasNoName) {
  const auto page = find_page_file("");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->type, "text/html; charset=utf-8");
  EXPECT_EQ(page->text.substr(0, 9), "<!doctype");
}

TEST(PageFiles, HaveTheirTypes) {
  EXPECT_EQ(find_page_file("style.css")->type, "text/css; charset=utf-8");
  EXPECT_EQ(find_page_file("app.js")->type, "text/javascript; charset=utf-8");
}

TEST(PageFiles, NoOthersAreServed) {
  for (const char* const name : {"../CMakeLists.txt", "/etc/passwd", "app", ".", "App.js"})
    EXPECT_FALSE(find_page_file(name)) << name;
}

TEST(PageFiles, ScriptsImportOnlyThoseThatAreThere) {
  const std::string script(find_page_file("app.js")->text);
  const std::vector<test::Match> imports = test::matches_of(script, "from '\\./([a-z_.]+)'");
  for (const test::Match& import : imports)
    EXPECT_TRUE(find_page_file(import[1])) << import[1];
  EXPECT_GT(imports.size(), 3U);
}

// Who may talk to the server of the live view.

const std::string token = "0123456789abcdef0123456789abcdef";

bool lets_in(const RequestSource& source, const std::string& address = "127.0.0.1") {
  try {
    AccessRules(token, address).check_request(source);
    return true;
  } catch (const AccessDenied&) {
    return false;
  }
}

bool lets_socket_in(const RequestSource& source) {
  try {
    AccessRules(token, "127.0.0.1").check_socket(source);
    return true;
  } catch (const AccessDenied&) {
    return false;
  }
}

const std::string page = "/" + token + "/";

TEST(Token, HasThirtyTwoDigitsAndIsAnotherEachTime) {
  std::set<std::string> tokens;
  for (int i = 0; i < 20; ++i)
    tokens.insert(make_token());
  EXPECT_EQ(tokens.size(), 20u);
  EXPECT_EQ(tokens.begin()->size(), 32u);
  EXPECT_EQ(tokens.begin()->find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Access, IsForTheTokenAtTheStartOfThePath) {
  const AccessRules rules(token, "127.0.0.1");
  EXPECT_EQ(rules.check_request({page, "127.0.0.1:80", ""}), "");
  EXPECT_EQ(rules.check_request({page + "app.js?x=1", "127.0.0.1:80", ""}), "app.js");
}

TEST(Access, IsNotForOtherTokens) {
  for (const std::string& target :
       {std::string("/"), std::string(), std::string("/app.js"), "/" + token, "//" + token + "/",
        "/" + token + "0/", "/" + token.substr(1) + "/", "/x?/" + token + "/",
        "/" + std::string(32, '0') + "/"})
    EXPECT_FALSE(lets_in({target, "127.0.0.1:80", ""})) << target;
}

TEST(Access, IsForTheNamesOfThisMachineAtAnyPort) {
  for (const char* const host :
       {"127.0.0.1:8080", "localhost:8080", "127.0.0.1", "[::1]:8080", "localhost"})
    EXPECT_TRUE(lets_in({page, host, ""})) << host;
}

TEST(Access, IsNotForOtherNamesThatLeadHere) {
  for (const char* const host : {"evil.example", "evil.example:8080", "127.0.0.1.evil.example",
                                 "localhost.evil.example:80", "", ":80", "127.0.0.2", "LOCALHOST"})
    EXPECT_FALSE(lets_in({page, host, ""})) << host;
}

TEST(Access, IsForTheOriginOfThePageAroundThisOne) {
  const AccessRules rules(token, "127.0.0.1", "https://hub.example:8888");
  for (const char* const origin : {"http://127.0.0.1:80", "https://hub.example:8888"})
    EXPECT_NO_THROW(rules.check_socket({page, "127.0.0.1:80", origin})) << origin;
  for (const char* const origin : {"https://hub.example", "http://hub.example:8888", ""})
    EXPECT_THROW(rules.check_socket({page, "127.0.0.1:80", origin}), AccessDenied) << origin;
}

TEST(Access, RefusesWhatIsNoOrigin) {
  for (const char* const text : {"hub.example", "http://", "http://a/b", "http://a; script-src *",
                                 "ftp://a", "http://a\r\nX: y", "*", "null"})
    EXPECT_THROW(AccessRules(token, "127.0.0.1", text), UsageError) << text;
}

TEST(Access, IsForTheAddressThatIsListenedOn) {
  EXPECT_TRUE(lets_in({page, "192.0.2.7:80", ""}, "192.0.2.7"));
  EXPECT_TRUE(lets_in({page, "[2001:db8::7]:80", ""}, "2001:db8::7"));
  EXPECT_FALSE(lets_in({page, "192.0.2.8:80", ""}, "192.0.2.7"));
}

TEST(Access, IsForEveryAddressInNumbersWhereAllAreListenedOn) {
  EXPECT_TRUE(lets_in({page, "192.0.2.7:80", ""}, "0.0.0.0"));
  EXPECT_TRUE(lets_in({page, "[2001:db8::7]:80", ""}, "::"));
  EXPECT_FALSE(lets_in({page, "evil.example:80", ""}, "0.0.0.0"));
  EXPECT_FALSE(lets_in({page, ":80", ""}, "0.0.0.0"));
}

TEST(Access, IsForThePagesOwnOriginOnly) {
  EXPECT_TRUE(lets_in({page, "127.0.0.1:80", "http://127.0.0.1:80"}));
  for (const char* const origin :
       {"http://evil.example", "http://127.0.0.1:81", "http://localhost:80", "https://127.0.0.1:80",
        "http://127.0.0.1:80/", "null"})
    EXPECT_FALSE(lets_in({page, "127.0.0.1:80", origin})) << origin;
}

TEST(Access, OfSocketsNeedsAnOrigin) {
  EXPECT_TRUE(lets_socket_in({page + "live", "127.0.0.1:80", "http://127.0.0.1:80"}));
  EXPECT_FALSE(lets_socket_in({page + "live", "127.0.0.1:80", ""}));
}

}  // namespace
}  // namespace splotchcl::view
