#include "publish/web_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames/random_frames.h"

namespace splotchcl::test {
namespace {

std::string page_called(const std::string& title) {
  Frame frame = SceneMaker(1).make();
  frame.components.resize(1);
  frame.components.front().absorption = {Absorption::Kind::none, 0};
  WebPage page;
  page.title = title;
  page.unit = "kpc";
  return make_web_page(page, frame, pack(light_splats(frame)));
}

TEST(WebPage, LoadsNothing) {
  const std::string page = page_called("A universe");
  EXPECT_THAT(page, testing::HasSubstr("<title>A universe</title>"));
  for (const char* const loads : {"src=", "href=", "http:", "https:", "fetch(", "import "})
    EXPECT_THAT(page, testing::Not(testing::HasSubstr(loads))) << loads;
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("{{")));
}

TEST(WebPage, ShowsATitleAsItIs) {
  const std::string page = page_called("</script><b>&{{splats}}");
  EXPECT_THAT(page, testing::HasSubstr("<title>&lt;/script>&lt;b>&amp;{{splats}}</title>"));
  EXPECT_THAT(page, testing::HasSubstr("\\u003c/script>\\u003cb>&{{splats}}"));
}

}  // namespace
}  // namespace splotchcl::test
