#include "certificate/color_errors.h"

#include <gtest/gtest.h>

#include "reference/frames.h"

namespace splotchcl::test {
namespace {

double part_of_range(Scaling scaling, double minimum, double maximum) {
  DrawnComponent component =
      component_of({{0, 0, 1, 3, 1}}, {"two colors", {{1, 0, 0}, {0, 0, 1}}, {}});
  component.color = {scaling, minimum, maximum};
  return part_of_colors(frame_of(10, 10, {component}));
}

TEST(ColorErrors, GrowAsTheRangeBecomesNarrowBesideItsLogarithms) {
  const double wide = part_of_range(Scaling::log, 1, 6);
  EXPECT_LT(wide, 2e-6);
  // Of the logarithm 24 over the range, beside 2 of the difference.
  EXPECT_NEAR(part_of_range(Scaling::log, 5.995, 6) / wide, 4802 / 6.8, 1);
}

TEST(ColorErrors, DoNotFollowTheRangeOfFieldsThatAreTakenAsTheyAre) {
  EXPECT_EQ(part_of_range(Scaling::linear, 0, 1), part_of_range(Scaling::linear, 1e6, 1e6 + 1));
}

TEST(ColorErrors, AreNoneOfAPaletteOfOneColor) {
  DrawnComponent component = component_of({{0, 0, 1, 3, 1}}, one_color(1, 0.5, 0));
  component.color = {Scaling::log, 5.999, 6};
  EXPECT_EQ(part_of_colors(frame_of(10, 10, {component})), 0);
}

}  // namespace
}  // namespace splotchcl::test
