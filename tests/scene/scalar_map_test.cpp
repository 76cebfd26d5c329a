#include "scene/scalar_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace splotchcl::test {
namespace {

TEST(ScalarMap, TellsTheLeastOfLogarithmsAndAsinhBeforeTheyAreTaken) {
  EXPECT_NEAR(least_before_scaling({Scaling::log, 3, 4}).value(), 1000, 1e-10);
  EXPECT_NEAR(least_before_scaling({Scaling::asinh, -1, 4}).value(), std::sinh(-1), 1e-15);
  EXPECT_FALSE(least_before_scaling({Scaling::linear, 3, 4}));
}

TEST(ScalarMap, TellsNoLeastThatFloatsCannotTakeFromOthers) {
  EXPECT_FALSE(least_before_scaling({Scaling::log, -38.5, -38}));
  EXPECT_FALSE(least_before_scaling({Scaling::log, -37, 0.5}));
  EXPECT_FALSE(least_before_scaling({Scaling::log, 39, 40}));
  EXPECT_FALSE(least_before_scaling({Scaling::asinh, 0, 43}));
}

}  // namespace
}  // namespace splotchcl::test
