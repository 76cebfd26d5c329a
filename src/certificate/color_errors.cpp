#include "certificate/color_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

// Of a field's scaled value, of its largest in the range: of the logarithm or asinh, and of the
// difference from the least. Where that is taken first, all roundings are parts of the place.
double error_of_place(const ScalarMap& map) {
  constexpr double rounding = 0x1p-24, of_function = 4, of_difference = 2, from_least = 24;
  const double range = std::abs(map.maximum - map.minimum);
  const double largest = std::max({1.0, std::abs(map.minimum), std::abs(map.maximum)});
  if (map.scaling == Scaling::linear || range == 0) return of_difference * rounding;
  if (least_before_scaling(map)) return from_least * rounding;
  return rounding * (of_function * largest / range + of_difference);
}

double largest_channel(const Rgb& color) {
  return static_cast<double>(std::max({color[0], color[1], color[2]}));
}

// How much the color changes from one end of the palette to the other if it does so all the way as
// between the two knots where it does most, in parts of the light there.
double steepest_part(const std::vector<Rgb>& knots) {
  double steepest = 0;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    double change = 0;
    for (std::size_t c = 0; c < 3; ++c)
      change = std::max(change, static_cast<double>(std::abs(knots[k][c] - knots[k - 1][c])));
    const double brighter = std::max(largest_channel(knots[k - 1]), largest_channel(knots[k]));
    if (change > 0) steepest = std::max(steepest, change / (0.5 * brighter));
  }
  return steepest * static_cast<double>(std::max<std::size_t>(knots.size(), 1) - 1);
}

double part_of(const DrawnComponent& component) {
  const double steepest = std::max(steepest_part(component.palette.emission),
                                   steepest_part(component.palette.absorption));
  double part = steepest * error_of_place(component.color);
  if (!component.particles.intensity.is_absent()) part += 2 * error_of_place(component.intensity);
  return part;
}

}  // namespace

double part_of_colors(const Frame& frame) {
  double largest = 0;
  for (const DrawnComponent& component : frame.components)
    largest = std::max(largest, part_of(component));
  return largest;
}

}  // namespace splotchcl
