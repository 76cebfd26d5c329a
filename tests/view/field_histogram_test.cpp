// How values are distributed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "view/answers.h"

namespace splotchcl::view {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FieldHistogram, CountsValuesInEqualBins) {
  const auto histogram = field_histogram(Column::owning({0, 1, 2, 3, 4, 4, 4}), Scaling::linear, 4);
  EXPECT_EQ(histogram.minimum, 0);
  EXPECT_EQ(histogram.maximum, 4);
  EXPECT_THAT(histogram.counts, ElementsAre(1, 1, 1, 4));
}

TEST(FieldHistogram, HasBinsThatAreEqualAfterScaling) {
  const auto histogram = field_histogram(Column::owning({1, 5, 50, 500, 1000}), Scaling::log, 3);
  EXPECT_NEAR(histogram.maximum, 1000, 1e-9);
  EXPECT_THAT(histogram.counts, ElementsAre(2, 1, 2));
}

TEST(FieldHistogram, LeavesOutWhatHasNoScaledValue) {
  const auto histogram = field_histogram(Column::owning({-1, 0, 10, 100}), Scaling::log, 2);
  EXPECT_THAT(histogram.counts, ElementsAre(1, 1));
  EXPECT_THAT(field_histogram(Column::owning({-1, 0}), Scaling::log, 2).counts, IsEmpty());
}

TEST(FieldHistogram, HasOneBinOfValuesThatAreAllEqual) {
  EXPECT_THAT(field_histogram(Column::owning({7, 7}), Scaling::linear, 3).counts,
              ElementsAre(2, 0, 0));
}

}  // namespace
}  // namespace splotchcl::view
