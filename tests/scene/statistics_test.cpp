#include "scene/statistics.h"

#include <gtest/gtest.h>

#include <limits>

namespace splotchcl {
namespace {

std::vector<float> count_to(int last) {
  std::vector<float> values;
  // In an order of its own: 1009 is prime, so all numbers come.
  for (int i = 0; i <= last; ++i)
    values.push_back(static_cast<float>(i * 1009 % (last + 1)));
  return values;
}

TEST(Percentile, LiesBetweenTheNeighbors) {
  std::vector<double> values = {30, 10, 20};
  EXPECT_EQ(percentile(values, 0), 10);
  EXPECT_EQ(percentile(values, 0.25), 15);
  EXPECT_EQ(percentile(values, 0.5), 20);
  EXPECT_EQ(percentile(values, 1), 30);
}

TEST(BulkRange, LeavesOutHalfAPercentAtEachEnd) {
  const auto range = bulk_range(Column::owning(count_to(1000)), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->minimum, 5, 1e-9);
  EXPECT_NEAR(range->maximum, 995, 1e-9);
}

TEST(BulkRange, IsOfTheScaledValues) {
  const auto range = bulk_range(Column::owning({1, 10, 100, 1000, 10000}), Scaling::log);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->minimum, 0.02, 1e-9);
  EXPECT_NEAR(range->maximum, 3.98, 1e-9);
}

TEST(BulkRange, PassesOverValuesThatHaveNoPlace) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto range = bulk_range(Column::owning({0, -3, nan, infinity, 100, 100}), Scaling::log);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 2);
  EXPECT_EQ(range->maximum, 2);
}

TEST(BulkRange, IsNothingWhenNoValueHasAPlace) {
  EXPECT_FALSE(bulk_range(Column::owning({0, -3}), Scaling::log));
  EXPECT_FALSE(bulk_range(Column::owning({}), Scaling::linear));
}

TEST(BulkRange, OfOneValueForAllIsThatValue) {
  const auto range = bulk_range(Column::uniform(7), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 7);
  EXPECT_EQ(range->maximum, 7);
}

TEST(SampleStride, LooksAtNoMoreThanTheLimit) {
  EXPECT_EQ(sample_stride(0, 10), 1u);
  EXPECT_EQ(sample_stride(10, 10), 1u);
  EXPECT_EQ(sample_stride(11, 10), 2u);
  EXPECT_EQ(sample_stride(100, 10), 10u);
}

TEST(BulkRange, OfMoreThanTwoMillionValuesIsOfEvenlySpacedOnes) {
  std::vector<float> values(4000001, 1);
  for (std::size_t i = 0; i < values.size(); i += 3)
    values[i] = 5;  // every third is looked at
  const auto range = bulk_range(Column::owning(std::move(values)), Scaling::linear);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->minimum, 5);
}

}  // namespace
}  // namespace splotchcl
