// Lists of one tile that are cut into many segments.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "device/cases.h"
#include "device/pictures.h"

namespace splotchcl::test {
namespace {

class LongLists : public PictureTest, public testing::WithParamInterface<PlanAndShape> {};

// 50000 clouds in one tile of either shape, several times the length of a segment.
TEST_P(LongLists, GiveTheOraclesPicture) {
  const auto [plan, shape] = GetParam();
  Random random(101);
  std::vector<Cloud> clouds;
  std::vector<float> colors;
  for (int i = 0; i < 50000; ++i) {
    clouds.push_back({random.uniform(-7, 7), random.uniform(-7, 7), random.uniform(1, 100),
                      random.logarithmic(0.1, 2), random.logarithmic(1e-3, 1e-1)});
    colors.push_back(static_cast<float>(random.uniform()));
  }
  DrawnComponent component = component_of(clouds, two_colors());
  component.particles.color = Column::owning(colors);
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.01};
  const Frame frame = frame_of(16, 16, {component});
  ASSERT_EQ(choose_light(frame), plan);
  const ReferenceImage exact = reference::render(frame);
  EXPECT_GT(largest_value(exact), 0.2);
  EXPECT_LE(largest_error(draw(frame, shape), exact), frame.tolerance);
  EXPECT_EQ(renderer(shape).stats().tile_entries, 50000u);
}

// Each rounds the sum alike: only sums of blocks keep them from adding up.
TEST_P(LongLists, GiveTheOraclesPictureOfEqualNarrowSplatsAtASmallTolerance) {
  const auto [plan, shape] = GetParam();
  constexpr int count = 16000;
  const std::vector<Cloud> clouds(count, Cloud{0.3, 0.2, 10, 0.4, 2.0 / count});
  DrawnComponent component = component_of(clouds, two_colors());
  if (plan == LightPlan::emission) component.absorption = {Absorption::Kind::none, 0};
  if (plan == LightPlan::ordered) component.absorption = {Absorption::Kind::gray, 0.01};
  Frame frame = frame_of(16, 16, {component});
  frame.tolerance = 1.5e-6;
  ASSERT_FALSE(make_plan(frame).is_extended());
  EXPECT_LE(largest_error(draw(frame, shape), reference::render(frame)), frame.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Plans, LongLists, each_plan_and_shape(), name_of_case);

}  // namespace
}  // namespace splotchcl::test
