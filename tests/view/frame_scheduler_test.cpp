#include "view/frame_scheduler.h"

#include "testing.h"

namespace splotchcl::view {
namespace {

using Stage = FrameScheduler::Stage;
using std::chrono::milliseconds;

// What is drawn next for a page.

const FrameScheduler::Time start;

TEST(FrameScheduler, HasNothingToDrawWithoutInput) {
  const FrameScheduler scheduler;
  EXPECT_FALSE(scheduler.next(start));
  EXPECT_FALSE(scheduler.wake_time());
}

TEST(FrameScheduler, TheNewestInputWins) {
  FrameScheduler scheduler;
  for (int i = 0; i < 200; ++i)
    scheduler.take_input(true, start);
  const auto task = scheduler.next(start);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->input, 200u);
  scheduler.sent(*task);
  EXPECT_FALSE(scheduler.next(start));  // none of the others
}

TEST(FrameScheduler, APreviewComesAtOnceAndTheExactPictureAtRest) {
  FrameScheduler scheduler;
  scheduler.take_input(false, start);
  const auto preview = scheduler.next(start);
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->stage, Stage::preview);
  scheduler.acknowledge(scheduler.sent(*preview));
  EXPECT_FALSE(scheduler.next(start));
  ASSERT_EQ(scheduler.wake_time(), start + FrameScheduler::rest);
  const auto exact = scheduler.next(start + FrameScheduler::rest);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->stage, Stage::exact);
  scheduler.acknowledge(scheduler.sent(*exact));
  EXPECT_FALSE(scheduler.next(start + milliseconds(10000)));
  EXPECT_FALSE(scheduler.wake_time());
}

TEST(FrameScheduler, WhileSomethingMovesRestIsLonger) {
  FrameScheduler scheduler;
  scheduler.take_input(true, start);
  scheduler.acknowledge(scheduler.sent(*scheduler.next(start)));
  EXPECT_FALSE(scheduler.next(start + FrameScheduler::rest));
  EXPECT_TRUE(scheduler.next(start + FrameScheduler::rest_while_moving));
}

TEST(FrameScheduler, TwoFramesAtMostAreOnTheirWay) {
  FrameScheduler scheduler;
  std::uint64_t first = 0;
  for (int i = 0; i < 2; ++i) {
    scheduler.take_input(true, start);
    const std::uint64_t frame = scheduler.sent(*scheduler.next(start));
    if (i == 0) first = frame;
  }
  const std::uint64_t newest = scheduler.take_input(true, start);
  EXPECT_FALSE(scheduler.next(start));
  EXPECT_FALSE(scheduler.wake_time());
  scheduler.acknowledge(99);  // never sent
  EXPECT_FALSE(scheduler.next(start));
  scheduler.acknowledge(first);
  ASSERT_TRUE(scheduler.next(start));
  EXPECT_EQ(scheduler.next(start)->input, newest);
}

TEST(FrameScheduler, NewInputMakesAnExactPictureUseless) {
  FrameScheduler scheduler;
  const FrameScheduler::Task exact{Stage::exact, scheduler.take_input(false, start)};
  EXPECT_FALSE(scheduler.is_outdated(exact));
  scheduler.take_input(true, start);
  EXPECT_TRUE(scheduler.is_outdated(exact));
}

TEST(FrameScheduler, WhatFailedIsNotTriedAgain) {
  FrameScheduler scheduler;
  const std::uint64_t input = scheduler.take_input(false, start);
  scheduler.failed({Stage::preview, input});
  scheduler.failed({Stage::exact, input});
  EXPECT_FALSE(scheduler.next(start + milliseconds(10000)));
  scheduler.take_input(false, start);
  EXPECT_TRUE(scheduler.next(start));
}

// How much of the data previews show.

constexpr double target = 1.0 / 30;

TEST(PreviewQuality, EndsWithAllParticlesAtFullSize) {
  for (const std::uint64_t particles : {1ull, 32768ull, 32769ull, 16777216ull}) {
    const PreviewLevel finest = preview_levels(particles).back();
    EXPECT_EQ(finest.particles, 0u) << particles;
    EXPECT_EQ(finest.divisor, 1) << particles;
  }
}

TEST(PreviewQuality, BeginsCoarse) {
  const PreviewQuality quality(16777216, target);
  EXPECT_EQ(quality.level().particles, 32768u);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, GetsFinerWhilePreviewsAreQuick) {
  PreviewQuality quality(16777216, target);
  for (int i = 0; i < 100; ++i)
    quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().particles, 0u);
  EXPECT_EQ(quality.level().divisor, 1);
}

TEST(PreviewQuality, GetsCoarserWhenOneIsTooSlow) {
  PreviewQuality quality(1000000, target);
  quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().divisor, 2);
  quality.drawn(2 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, DoesNotGoBackAndForth) {
  PreviewQuality quality(1000000, target);
  quality.drawn(0.1 * target);
  quality.drawn(2 * target);
  for (int i = 0; i < 30; ++i)
    quality.drawn(0.1 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

TEST(PreviewQuality, StaysWhereTheNextLevelWouldBeTooSlow) {
  PreviewQuality quality(1000000, target);
  for (int i = 0; i < 100; ++i)
    quality.drawn(0.6 * target);
  EXPECT_EQ(quality.level().divisor, 4);
}

}  // namespace
}  // namespace splotchcl::view
