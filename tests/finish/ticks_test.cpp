#include "finish/ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/scalar_map.h"

namespace splotchcl::test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> labels_of(const ScalarMap& map, int most = 6) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks_of(map, most, true)) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  return labels;
}

TEST(Ticks, OfALinearAxisHaveRoundSteps) {
  EXPECT_THAT(labels_of({Scaling::linear, 0, 1}),
              ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
  EXPECT_THAT(labels_of({Scaling::linear, -3.2, 11}), ElementsAre("0", "5", "10"));
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTen) {
  EXPECT_THAT(labels_of({Scaling::log, 3.5, 7.2}), ElementsAre("10⁴", "10⁵", "10⁶", "10⁷"));
  EXPECT_THAT(labels_of({Scaling::log, -1.1, 2}), ElementsAre("0.1", "1", "10", "100"));
}

TEST(Ticks, OfFewDecadesHaveNumbersBetween) {
  EXPECT_THAT(labels_of({Scaling::log, 0, 1}), ElementsAre("1", "2", "5", "10"));
}

TEST(Ticks, OfManyDecadesLeaveSomeOut) {
  EXPECT_LE(labels_of({Scaling::log, -20, 20}).size(), 7U);
  EXPECT_GE(labels_of({Scaling::log, -20, 20}).size(), 4U);
}

TEST(Ticks, OfAnAsinhAxisAreTheSameOnBothSides) {
  EXPECT_THAT(labels_of({Scaling::asinh, std::asinh(-1500.0), std::asinh(1500.0)}, 9),
              ElementsAre("-1000", "-100", "-10", "0", "10", "100", "1000"));
}

TEST(Ticks, StandWhereTheScalingPutsTheirValues) {
  for (const ScalarMap& map :
       {ScalarMap{Scaling::linear, -7, 12.5}, ScalarMap{Scaling::log, -3.3, 5.1},
        ScalarMap{Scaling::log, 0.1, 0.4}, ScalarMap{Scaling::asinh, -2, 9}}) {
    const std::vector<Tick> ticks = ticks_of(map, 6, true);
    ASSERT_GE(ticks.size(), 2U);
    for (const Tick& tick : ticks)
      EXPECT_NEAR(tick.position, normalized(tick.value, map), 1e-9);
  }
}

TEST(Ticks, OfAnAxisWithoutLengthAreOne) {
  EXPECT_THAT(labels_of({Scaling::linear, 4, 4}), ElementsAre("4"));
}

TEST(NumberLabels, AreShort) {
  EXPECT_EQ(number_label(0, true), "0");
  EXPECT_EQ(number_label(2500, true), "2500");
  EXPECT_EQ(number_label(-0.25, true), "-0.25");
  EXPECT_EQ(number_label(3e6, true), "3×10⁶");
  EXPECT_EQ(number_label(1e-12, true), "10⁻¹²");
  EXPECT_EQ(number_label(3e6, false), "3e+06");
}

TEST(RoundNumbers, AreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_below(4.9), 2);
  EXPECT_DOUBLE_EQ(round_below(5), 5);
  EXPECT_DOUBLE_EQ(round_below(0.0173), 0.01);
  EXPECT_DOUBLE_EQ(round_below(1000), 1000);
}

}  // namespace
}  // namespace splotchcl::test
