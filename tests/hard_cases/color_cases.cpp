// Colors of stars so bright that roundings of their places in a palette show.
#include <cmath>

#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"

namespace splotchcl::test {
namespace {

const std::vector<LightPlan> emission = {LightPlan::emission};

Frame star_of_color(float value, const Palette& palette, const ScalarMap& map, double brightness) {
  DrawnComponent star = component_of({{0.5, 0.5, 1, 2, 1}}, palette);
  star.particles.color = Column::uniform(value);
  star.color = map;
  star.brightness = brightness;
  star.absorption = {Absorption::Kind::none, 0};
  return frame_of(64, 64, {star});
}

// From 10 to 1e8.
constexpr ScalarMap seven_decades = {Scaling::log, 1, 8};

Palette dark_in_green() {
  Palette palette;
  palette.emission = {Rgb{1, 0, 0}, Rgb{1, 0, 0}, Rgb{1, 1, 0}};
  return palette;
}

Palette alternating(int knots) {
  Palette palette;
  for (int k = 0; k < knots; ++k)
    palette.emission.push_back(k % 2 == 0 ? Rgb{1, 0, 0} : Rgb{0, 1, 1});
  return palette;
}

HardCase star(const std::string& name, const std::string& why, double tolerance,
              const Frame& drawn) {
  return {name, why,
          [drawn, tolerance](LightPlan) {
            Frame frame = drawn;
            frame.tolerance = tolerance;
            return frame;
          },
          emission};
}

}  // namespace

std::vector<HardCase> color_cases() {
  const Frame at_a_knot = star_of_color(31622.8f, dark_in_green(), seven_decades, 1e5);
  const Frame many_knots = star_of_color(31500, alternating(300), seven_decades, 5.5e3);
  const Frame linear = star_of_color(0.3331f, alternating(300), {Scaling::linear, 0, 1}, 5.5e3);
  return {
      star("StarOfABrightChannelAndADarkOne", "a place in the palette is known to a rounding", 1e-3,
           at_a_knot),
      star("StarOfABrightChannelAndADarkOneAt1e_4", "the same at a smaller tolerance", 1e-4,
           at_a_knot),
      star("StarInAPaletteOf300Knots", "colors change 300 times along the palette", 1e-3,
           many_knots),
      star("StarInAPaletteOf300KnotsAt1e_5", "the same at a smaller tolerance", 1e-5, many_knots),
      star("StarOfALinearFieldIn300Knots", "the same of a field that is no logarithm", 1e-4,
           linear),
  };
}

}  // namespace splotchcl::test
