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

TEST(ColorErrors, DoNotFollowTheRange) {
  EXPECT_EQ(part_of_range(Scaling::linear, 0, 1), part_of_range(Scaling::linear, 1e6, 1e6 + 1));
  EXPECT_EQ(part_of_range(Scaling::log, 1, 6), part_of_range(Scaling::log, 5.995, 6));
  EXPECT_EQ(part_of_range(Scaling::asinh, -1, 20), part_of_range(Scaling::asinh, 20, 20.01));
  EXPECT_LT(part_of_range(Scaling::log, 1, 6), 6e-6);
}

TEST(ColorErrors, GrowAsTheRangeBecomesNarrowBesideLogarithmsOfWhatFloatsHardlyHold) {
  // Of the logarithm 4 * 39 over the range, beside 2 of the difference.
  EXPECT_NEAR(part_of_range(Scaling::log, -39, -38.995) / part_of_range(Scaling::log, -39, -34),
              31202 / 33.2, 1);
}

TEST(ColorErrors, AreNoneOfAPaletteOfOneColor) {
  DrawnComponent component = component_of({{0, 0, 1, 3, 1}}, one_color(1, 0.5, 0));
  component.color = {Scaling::log, 5.999, 6};
  EXPECT_EQ(part_of_colors(frame_of(10, 10, {component})), 0);
}

}  // namespace
}  // namespace splotchcl::test
