#include "tree/field_colors.h"

#include "scene/scalar_map.h"
#include "testing.h"
#include "tree/sampled_field.h"

namespace splotchcl::test {
namespace {

TEST(FieldPlaces, AreThoseOfSingleValues) {
  const ScalarMap maps[] = {{Scaling::log, 1, 5},          {Scaling::linear, 0, 1},
                            {Scaling::linear, -3, 40},     {Scaling::asinh, -5, 5},
                            {Scaling::linear, 1000, 1001}, {Scaling::log, 3, 3.001}};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  for (const ScalarMap& map : maps) {
    const FieldPlaces places(map);
    const double narrow = map.maximum - map.minimum;
    for (int i = 0; i < 1000; ++i) {
      const double at = map.minimum + narrow * uniform(random);
      const auto value = static_cast<float>(unscaled(at, map.scaling));
      // A float's own rounding of values in a narrow range, and of the table.
      const double rounding = (std::abs(at) + std::abs(map.minimum) + 1) * 3e-7 / narrow;
      EXPECT_NEAR(static_cast<double>(places(ordered_value(value))),
                  normalized(static_cast<double>(value), map), 1e-5 + 1e-5 / narrow + rounding);
    }
    EXPECT_EQ(places(ordered_value(-1e30f)), normalized(-1e30, map));
  }
}

TEST(PaletteWay, HasThePalettesColorsAndTheLengthOfTheirWay) {
  Palette palette;
  palette.emission = {Rgb{0, 0, 1}, Rgb{1, 0.5f, 0}, Rgb{1, 0.5f, 1}, Rgb{0.5f, 0.5f, 1}};
  const PaletteWay way(palette);
  for (const double place : {0.0, 0.1, 1.0 / 3, 0.5, 0.9, 1.0}) {
    const auto exact = sample_knots(palette.emission, place);
    const auto color = way.color(static_cast<float>(place));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(color[c]), exact[c], 1e-6);
  }
  EXPECT_NEAR(way.step(1).way, 1 + 1 + 0.5, 1e-6);
  EXPECT_NEAR(way.step(0).way, 0, 1e-6);
}

}  // namespace
}  // namespace splotchcl::test
