#include "certificate/color_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr double rounding = 0x1p-24;

// By how much a field's place in [0, 1] is off: by a part of itself, and of the whole range.
struct PlaceError {
  double of_itself = 0, of_range = 0;
};

// How exactly a place is known (kernels/project/limits.cl, project_extended.cl): of functions that
// are taken of the difference from the least value, of others, and of the difference.
struct FieldRoundings {
  double from_least, of_function, of_difference;
};

FieldRoundings roundings_of(const FramePlan& plan) {
  // Of numbers of 45 bits, and of their logarithms.
  if (plan.is_extended()) return {3e-10, 3e-11, 0x1p-42};
  if (plan.certify) return {24 * rounding, 4 * rounding, 4 * rounding};
  return {6 * rounding, 2 * rounding, 2 * rounding};
}

PlaceError error_of_place(const ScalarMap& map, const FieldRoundings& roundings) {
  const double range = std::abs(map.maximum - map.minimum);
  if (range == 0) return {};
  if (map.scaling == Scaling::linear) return {roundings.of_difference, 0};
  if (least_before_scaling(map)) return {roundings.from_least, 0};
  const double largest = std::max({1.0, std::abs(map.minimum), std::abs(map.maximum)});
  return {roundings.of_difference, roundings.of_function * largest / range};
}

double largest_channel(const Rgb& color) {
  return static_cast<double>(std::max({color[0], color[1], color[2]}));
}

// Between the two knots where it is most: in parts of the brightest channel, halfway to the
// brighter knot.
double part_of_knots(const std::vector<Rgb>& knots, const PlaceError& place) {
  const auto steps = static_cast<double>(std::max<std::size_t>(knots.size(), 1) - 1);
  double largest = 0;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    double change = 0;
    for (std::size_t c = 0; c < 3; ++c)
      change = std::max(change, static_cast<double>(std::abs(knots[k][c] - knots[k - 1][c])));
    if (change == 0) continue;
    const double brighter = std::max(largest_channel(knots[k - 1]), largest_channel(knots[k]));
    const double farthest = static_cast<double>(k) / steps;
    const double moved = steps * (place.of_itself * farthest + place.of_range);
    largest = std::max(largest, change * moved / (0.5 * brighter));
  }
  return largest;
}

double part_of(const DrawnComponent& component, const FieldRoundings& roundings) {
  double part = 0;
  if (!component.particles.color.is_absent()) {
    const PlaceError place = error_of_place(component.color, roundings);
    part = std::max(part_of_knots(component.palette.emission, place),
                    part_of_knots(component.palette.absorption, place));
  }
  if (!component.particles.intensity.is_absent()) {
    const PlaceError place = error_of_place(component.intensity, roundings);
    part += 2 * (place.of_itself + place.of_range);
  }
  return part;
}

}  // namespace

double part_of_colors(const Frame& frame, const FramePlan& plan) {
  const FieldRoundings roundings = roundings_of(plan);
  double largest = 0;
  for (const DrawnComponent& component : frame.components)
    largest = std::max(largest, part_of(component, roundings));
  return largest;
}

}  // namespace splotchcl
