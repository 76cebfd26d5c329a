#include "publish/web_page.h"

#include "frames/random_frames.h"
#include "testing.h"

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
  EXPECT_THAT(page, HasSubstr("<title>A universe</title>"));
  for (const char* const loads : {"src=", "href=", "http:", "https:", "fetch(", "import "})
    EXPECT_THAT(page, Not(HasSubstr(loads))) << loads;
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(WebPage, ShowsATitleAsItIs) {
  const std::string page = page_called("</script><b>&{{splats}}");
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script>&lt;b>&amp;{{splats}}</title>"));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>&{{splats}}"));
}

}  // namespace
}  // namespace splotchcl::test
