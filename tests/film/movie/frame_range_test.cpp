#include "film/movie/numbered_files.h"
#include "film/path/path_messages.h"
#include "testing.h"

namespace splotchcl {
namespace {

using test::refusal;
using ::testing::SizeIs;

TEST(SelectFrames, CountsFromTheFirstInStepsAndLeavesOutTheEnd) {
  EXPECT_THAT(select_frames("3:9:2", 10), ElementsAre(3, 5, 7));
  EXPECT_THAT(select_frames("8:", 10), ElementsAre(8, 9));
  EXPECT_THAT(select_frames(":2", 10), ElementsAre(0, 1));
  EXPECT_THAT(select_frames("::4", 10), ElementsAre(0, 4, 8));
  EXPECT_THAT(select_frames("7", 10), ElementsAre(7));
  EXPECT_THAT(select_frames("", 3), ElementsAre(0, 1, 2));
}

TEST(SelectFrames, RefusesWhatIsNoRangeOfTheFilm) {
  for (const std::string text : {"a", "1:2:3:4", "-1:3", "1:3:0", "1.5", "1,3", "99999999999"})
    EXPECT_THAT(refusal([&] { select_frames(text, 10); }), HasSubstr("is not FIRST:END:STEP"));
  for (const std::string text : {"3:3", "5:4", "0:11", "10"})
    EXPECT_THAT(refusal([&] { select_frames(text, 10); }), HasSubstr("frames from 0 to 9"));
}

TEST(SelectPart, SharesAllFramesOut) {
  const std::vector<int> frames = select_frames("", 17);
  std::vector<int> together;
  for (int part = 1; part <= 5; ++part) {
    const std::vector<int> share = select_part(std::to_string(part) + "/5", frames);
    EXPECT_GE(share.size(), 3U);
    EXPECT_LE(share.size(), 4U);
    together.insert(together.end(), share.begin(), share.end());
  }
  EXPECT_EQ(together, frames);
}

TEST(SelectPart, MayBeEmptyWithMorePartsThanFrames) {
  EXPECT_THAT(select_part("1/4", {5}), SizeIs(0));
  EXPECT_THAT(select_part("4/4", {5}), ElementsAre(5));
}

TEST(SelectPart, RefusesWhatIsNoPart) {
  for (const std::string text : {"0/3", "4/3", "1", "1/", "/3", "a/b", "1/2/3", "-1/3"})
    EXPECT_THAT(refusal([&] { select_part(text, {1, 2, 3}); }), HasSubstr("expected K/N"));
}

std::string file_at(const std::string& pattern, int number) {
  return NumberedFiles::require(pattern, "--output").at(number).string();
}

TEST(NumberedFiles, HaveTheNumberAsPrintfWritesIt) {
  EXPECT_EQ(file_at("turn_%d.png", 7), "turn_7.png");
  EXPECT_EQ(file_at("turn_%04d.png", 7), "turn_0007.png");
  EXPECT_EQ(file_at("turn_%3d.png", 7), "turn_  7.png");
  EXPECT_EQ(file_at("turn_%02d.png", 1234), "turn_1234.png");
}

TEST(NumberedFiles, KeepTheirFolder) {
  EXPECT_EQ(file_at("a/100%/t%d.png", 3), "a/100%/t3.png");
}

TEST(NumberedFiles, NeedOneNumberInTheName) {
  for (const char* const pattern : {"turn.png", "turn_%s.png", "%d_%d.png", "turn_%", "%04x.png",
                                    "turn_%d/frame.png", "turn_%0000000d.png", "100%_%d.png", ""}) {
    EXPECT_FALSE(NumberedFiles::find(pattern)) << pattern;
    EXPECT_THROW(NumberedFiles::require(pattern, "--output"), UsageError) << pattern;
  }
}

}  // namespace
}  // namespace splotchcl
