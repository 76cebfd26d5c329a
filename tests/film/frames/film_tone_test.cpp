#include "film/frames/film_drawer.h"
#include "testing.h"

namespace splotchcl {
namespace {

FinishSettings found(double exposure, double white) {
  FinishSettings finish;
  finish.exposure = exposure;
  finish.white = white;
  return finish;
}

FinishSettings given(const FilmTone& tone, int frame, bool follows) {
  FinishSettings open;
  open.exposure.reset();
  open.white.reset();
  open.exposure_follows = follows;
  tone.give_to(open, frame);
  return open;
}

TEST(FilmTone, IsThatOfTheBrightestFrame) {
  FilmTone tone;
  tone.add(0, found(3, 2));
  tone.add(10, found(-1, 4));
  tone.add(20, found(0, 1));
  for (const int frame : {0, 7, 20}) {
    EXPECT_EQ(given(tone, frame, false).exposure, -1);
    EXPECT_EQ(given(tone, frame, false).white, 4);
  }
}

TEST(FilmTone, ThatFollowsChangesSlowly) {
  FilmTone tone;
  for (int frame = 0; frame <= 80; frame += 8)
    tone.add(frame, found(frame < 40 ? 0 : 6, frame < 40 ? 1 : 16));
  for (int frame = 1; frame <= 80; ++frame) {
    const FinishSettings now = given(tone, frame, true), before = given(tone, frame - 1, true);
    EXPECT_LE(std::abs(*now.exposure - *before.exposure), 0.5) << frame;
    EXPECT_LE(std::abs(std::log2(*now.white / *before.white)), 0.5) << frame;
  }
  EXPECT_EQ(given(tone, 0, true).exposure, 0);
  EXPECT_EQ(given(tone, 80, true).exposure, 6);
}

TEST(FilmTone, LeavesWhatIsGiven) {
  FilmTone tone;
  tone.add(0, found(3, 2));
  FinishSettings finish;
  finish.exposure = 1;
  finish.white.reset();
  tone.give_to(finish, 0);
  EXPECT_EQ(finish.exposure, 1);
  EXPECT_EQ(finish.white, 2);
}

TEST(FilmTone, IsFoundByFramesFromTheFirstToTheLast) {
  for (const bool follows : {false, true}) {
    EXPECT_EQ(frames_that_decide(1, follows), (std::vector<int>{0}));
    EXPECT_EQ(frames_that_decide(2, follows), (std::vector<int>{0, 1}));
    EXPECT_EQ(frames_that_decide(1000, follows).size(), 33U);
    EXPECT_EQ(frames_that_decide(1000, follows).back(), 999);
  }
  EXPECT_EQ(frames_that_decide(10, false), (std::vector<int>{0, 4, 9}));
  EXPECT_EQ(frames_that_decide(5, true), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(frames_that_decide(60, true).size(), 17U);
}

}  // namespace
}  // namespace splotchcl
