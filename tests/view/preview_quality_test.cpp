// How much of the data previews show.
#include <gtest/gtest.h>

#include "view/frame_scheduler.h"

namespace splotchcl::view {
namespace {

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
