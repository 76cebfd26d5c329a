#include "snapshot/field_statistics.h"

#include <gtest/gtest.h>

#include <limits>

namespace splotchcl {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(FieldStatistics, AreThoseOfTheValues) {
  const FieldStatistics statistics = find_statistics(Column::owning({3, -1, 4}));
  EXPECT_EQ(statistics.count, 3U);
  EXPECT_EQ(statistics.bad, 0U);
  EXPECT_EQ(statistics.minimum, -1);
  EXPECT_EQ(statistics.maximum, 4);
  EXPECT_EQ(statistics.mean, 2);
}

TEST(FieldStatistics, CountBadValuesAndLeaveThemOut) {
  const FieldStatistics statistics =
      find_statistics(Column::owning({nan, 2, infinity, 4, -infinity}));
  EXPECT_EQ(statistics.count, 5U);
  EXPECT_EQ(statistics.bad, 3U);
  EXPECT_EQ(statistics.infinite, 2U);
  EXPECT_EQ(statistics.minimum, 2);
  EXPECT_EQ(statistics.maximum, 4);
  EXPECT_EQ(statistics.mean, 3);
}

TEST(FieldStatistics, OfNothingGoodAreZero) {
  EXPECT_EQ(find_statistics(Column::owning({nan})).maximum, 0);
  EXPECT_EQ(find_statistics(Column::owning({nan})).bad, 1U);
  EXPECT_EQ(find_statistics(Column()).count, 0U);
}

TEST(FieldStatistics, OfAUniformColumnAreItsValue) {
  const FieldStatistics statistics = find_statistics(Column::uniform(7));
  EXPECT_EQ(statistics.minimum, 7);
  EXPECT_EQ(statistics.maximum, 7);
  EXPECT_EQ(statistics.mean, 7);
}

TEST(FieldStatistics, MeanOfManyLargeValuesIsNotRounded) {
  // In single precision the sum would stop growing at 2^24.
  EXPECT_EQ(find_statistics(Column::owning(std::vector<float>(20000000, 1))).mean, 1);
}

}  // namespace
}  // namespace splotchcl
