#include "publish/web_page.h"

#include "finish/tone.h"
#include "frames/random_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

std::string page_called(const std::string& title, const DisplayColor& text_color = {1, 1, 1}) {
  Frame frame = SceneMaker(1).make();
  frame.components.resize(1);
  frame.components.front().absorption = {Absorption::Kind::none, 0};
  WebPage page;
  page.title = title;
  page.finish.text_color = text_color;
  page.unit = "kpc";
  return make_web_page(page, frame, pack(light_splats(frame)));
}

// The number behind "least": what splats end at, in units of white.
double least_of(const FinishSettings& finish, double gamma) {
  Frame frame = SceneMaker(1).make();
  frame.components.resize(1);
  frame.components.front().absorption = {Absorption::Kind::none, 0};
  WebPage page;
  page.finish = finish;
  page.gamma = gamma;
  const std::string text = make_web_page(page, frame, pack(light_splats(frame)));
  const std::string name = "\"least\":";
  return std::stod(text.substr(text.find(name) + name.size()));
}

TEST(WebPage, EndsSplatsWhereTheyShowLessThanAStep) {
  for (const ToneCurve curve : {ToneCurve::linear, ToneCurve::asinh, ToneCurve::filmic}) {
    for (const double white : {1.0, 4.0}) {
      for (const double contrast : {1.0, 1.5}) {
        FinishSettings finish;
        finish.tone = curve;
        finish.white = white;
        finish.contrast = contrast;
        const double gamma = 2.2, least = least_of(finish, gamma);
        Image image(1, 1);
        std::fill_n(image.at(0, 0), 3, static_cast<float>(least * white));
        adjust_light(image, finish, gamma);
        const double shown = 255 * std::pow(image.at(0, 0)[0], 1 / gamma);
        EXPECT_LE(shown, 0.51) << least;
        EXPECT_LE(least, 2e-5);
      }
    }
  }
}

TEST(WebPage, LoadsNothing) {
  const std::string page = page_called("A universe");
  EXPECT_THAT(page, HasSubstr("<title>A universe</title>"));
  for (const char* const loads : {"src=", "href=", "http:", "https:", "fetch(", "import "})
    EXPECT_THAT(page, Not(HasSubstr(loads))) << loads;
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(WebPage, HasWordsOfTheScenesColorOnWhatTheyAreReadOn) {
  EXPECT_THAT(page_called("a"),
              HasSubstr("--ink: 255 255 255; --ground: 0 0 0; color-scheme: dark"));
  EXPECT_THAT(page_called("a", {0, 0, 0.4}),
              HasSubstr("--ink: 0 0 102; --ground: 255 255 255; color-scheme: light"));
  EXPECT_THAT(page_called("a", {1, 0.3, 0.2}), HasSubstr("--ground: 0 0 0"));
}

TEST(WebPage, ShowsATitleAsItIs) {
  const std::string page = page_called("</script><b>&{{splats}}");
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script>&lt;b>&amp;{{splats}}</title>"));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>&{{splats}}"));
}

}  // namespace
}  // namespace splotchcl::test
