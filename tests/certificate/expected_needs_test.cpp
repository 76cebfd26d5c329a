#include "certificate/expected_needs.h"

#include "parallel/for_blocks.h"
#include "reference/frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr int picture_size = 128;

// Clouds of sigma 3 all over the picture, in a regular pattern that is no crowd, and so many more
// in one place.
Frame field_with_crowd(std::size_t field, std::size_t crowd) {
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(field))));
  std::vector<Cloud> clouds;
  for (std::size_t i = 0; i < field; ++i) {
    const double x = (static_cast<double>(i % columns) + 0.5) / static_cast<double>(columns) - 0.5;
    const double y = (static_cast<double>(i / columns) + 0.5) / static_cast<double>(columns) - 0.5;
    clouds.push_back({picture_size * x, picture_size * y, 1, 3, 1e-3});
  }
  clouds.insert(clouds.end(), crowd, Cloud{0.3, 0.2, 1, 3, 0.5});
  return frame_of(picture_size, picture_size, {component_of(clouds, one_color(1, 1, 1))});
}

std::optional<SplatNeeds> needs_of(const Frame& frame) {
  return expected_needs(sample_clouds(frame), frame, make_plan(frame));
}

TEST(ExpectedNeeds, AreNoneWhereLightIsEven) {
  EXPECT_FALSE(needs_of(field_with_crowd(3000, 0)));
}

TEST(ExpectedNeeds, AreThoseOfSplatsInOnePlace) {
  const std::optional<SplatNeeds> needs = needs_of(field_with_crowd(100, 5000));
  ASSERT_TRUE(needs);
  const WidthNeed& of_their_width = needs->widths[2];  // sigma from 2 to 4
  EXPECT_GT(of_their_width.farther, 1);
  EXPECT_TRUE(of_their_width.light >= 2500 || needs->grid_light >= 2500);
  EXPECT_EQ(needs->widths[8].light, 0) << "of widths that no splat has";
}

TEST(ExpectedNeeds, AreFoundInASampleOfManyParticles) {
  const Frame frame = field_with_crowd(150000, 20000);
  ASSERT_TRUE(needs_of(frame));
  EXPECT_FALSE(needs_of(field_with_crowd(150000, 0)));
}

TEST(ExpectedNeeds, AreNoneOfPlansThatNoEstimateChecks) {
  Frame frame = field_with_crowd(100, 5000);
  EXPECT_FALSE(can_be_expected(make_plan(frame, {true, -1, true}))) << "a bound checks it";
  EXPECT_FALSE(can_be_expected(extend_plan(frame, make_plan(frame)))) << "nothing is left";
}

Frame with_stars_that_only_shine(Frame frame) {
  DrawnComponent stars = frame.components[0];
  stars.absorption = {Absorption::Kind::none, 0};
  frame.components.push_back(stars);
  return frame;
}

TEST(ExpectedNeeds, AreNoneWhereSourcesWithoutABrightestShineThroughWhatAbsorbs) {
  const Frame frame = with_stars_that_only_shine(field_with_crowd(60000, 10000));
  ASSERT_EQ(make_plan(frame).light, LightPlan::ordered);
  EXPECT_FALSE(needs_of(frame));
}

// Clouds of this width in one place, which nothing absorbs.
Frame crowd_of_light(double sigma) {
  const std::vector<Cloud> clouds(5000, Cloud{0.3, 0.2, 1, sigma, 0.5});
  Frame frame = frame_of(picture_size, picture_size, {component_of(clouds, one_color(1, 1, 1))});
  frame.components[0].absorption = {Absorption::Kind::none, 0};
  return frame;
}

// Those of wider ones follow from how bright the frame is (make_plan.cpp).
TEST(ExpectedNeeds, OfLightThatNothingAbsorbsAreThoseOfNarrowSplats) {
  const std::optional<SplatNeeds> narrow = needs_of(crowd_of_light(0.6));
  ASSERT_TRUE(narrow);
  EXPECT_GT(narrow->widths[0].light, 2500);
  EXPECT_GT(narrow->widths[0].farther, 1);
  const std::optional<SplatNeeds> wide = needs_of(crowd_of_light(12));
  EXPECT_TRUE(!wide || (wide->grid_light == 1 && wide->widths[4].farther == 0));
}

TEST(ExpectedNeeds, AreTheSameOnOneCore) {
  const Frame frame = field_with_crowd(100, 5000);
  const FramePlan plan = make_plan(frame);
  const BlockLoop all_cores = [](std::size_t count, std::size_t size, const auto& work) {
    for_blocks(count, size, work);
  };
  const auto on_all = expected_needs(sample_clouds(frame, all_cores), frame, plan, all_cores);
  const auto on_one = expected_needs(sample_clouds(frame), frame, plan);
  ASSERT_TRUE(on_all && on_one);
  EXPECT_EQ(on_all->widths[2].farther, on_one->widths[2].farther);
}

TEST(ExpectedNeeds, AreTheWholePicturesInACrop) {
  Frame frame = field_with_crowd(100, 5000);
  const auto of_whole = needs_of(frame);
  frame.crop = {100, 100, 20, 20};
  const auto of_crop = needs_of(frame);
  ASSERT_TRUE(of_whole && of_crop);
  EXPECT_EQ(of_whole->widths[2].farther, of_crop->widths[2].farther);
}

}  // namespace
}  // namespace splotchcl::test
