#include "certificate/color_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr double rounding = 0x1p-24;

// By how much a field's place in [0, 1] is off: by a part of itself, and of the whole range.
struct PlaceError {
  double of_itself = 0, of_range = 0;
};

// How exactly a place is known (kernels/project/limits.cl): of functions that
// are taken of the difference from the least value, of others, and of the difference.
struct FieldRoundings {
  double from_least, of_function, of_difference;
};

FieldRoundings roundings_of(const FramePlan& plan) {
  // Of numbers of 45 bits, and of their logarithms; asinh errs by three times as much.
  if (plan.is_extended()) return {1e-10, 3e-11, 0x1p-42};
  if (plan.certify) return {24 * rounding, 4 * rounding, 4 * rounding};
  return {6 * rounding, 2 * rounding, 2 * rounding};
}

PlaceError error_of_place(const ScalarMap& map, const FieldRoundings& roundings) {
  const double range = std::abs(map.maximum - map.minimum);
  if (range == 0) return {};
  if (map.scaling == Scaling::linear) return {roundings.of_difference, 0};
  if (least_before_scaling(map))
    return {(map.scaling == Scaling::asinh ? 3 : 1) * roundings.from_least, 0};
  const double largest = std::max({1.0, std::abs(map.minimum), std::abs(map.maximum)});
  return {roundings.of_difference, roundings.of_function * largest / range};
}

double largest_channel(const Rgb& color) {
  return static_cast<double>(std::max({color[0], color[1], color[2]}));
}

void take_largest(const ColorParts& parts, ColorParts& largest) {
  largest.of_brightest = std::max(largest.of_brightest, parts.of_brightest);
  largest.of_itself = std::max(largest.of_itself, parts.of_itself);
  largest.are_bounds &= parts.are_bounds;
}

// The brightest channel where it is faintest between two knots: at one of them, or where it becomes
// another one.
double faintest_between(const Rgb& before, const Rgb& behind) {
  double least = std::min(largest_channel(before), largest_channel(behind));
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t other = (c + 1) % 3;
    const auto apart = static_cast<double>(before[c] - before[other]);
    const double closer = apart - static_cast<double>(behind[c] - behind[other]);
    const double way = closer != 0 ? apart / closer : -1;
    if (way <= 0 || way >= 1) continue;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
      most = std::max(
          most, (1 - way) * static_cast<double>(before[i]) + way * static_cast<double>(behind[i]));
    least = std::min(least, most);
  }
  return least;
}

bool is_black(const Rgb& color) {
  return largest_channel(color) == 0;
}

// How bright the brightest channel is between knots, at least: that is half of the brighter one as
// an estimate, and where color begins with black, from which on it grows as its place does.
struct LeastLight {
  double brightest = 0;
  bool is_bound = true;
};
LeastLight least_between(const Rgb& before, const Rgb& behind, bool begins, bool as_bound) {
  constexpr double least_of_halfway = 0x1p-10;
  const double halfway = 0.5 * std::max(largest_channel(before), largest_channel(behind));
  const double faintest = faintest_between(before, behind);
  if (!as_bound || (begins && is_black(before))) return {std::max(halfway, faintest)};
  if (faintest < least_of_halfway * halfway) return {halfway, false};
  return {faintest};
}

// Of a channel between knot k - 1 and knot k of `steps`, where the brightest one is as bright.
ColorParts parts_between(float before, float behind, double brightest, double k, double steps,
                         const PlaceError& place) {
  const double change = static_cast<double>(std::abs(behind - before));
  if (change == 0) return {};
  const double moved = change * (place.of_itself * k + place.of_range * steps);
  const double least = static_cast<double>(std::min(before, behind));
  // From no light on it grows as its place does.
  if (before == 0 && k == 1 && place.of_range == 0) return {moved / brightest, place.of_itself};
  return {moved / brightest, least > 0 ? moved / least : std::numeric_limits<double>::infinity()};
}

ColorParts parts_of_knots(const std::vector<Rgb>& knots, const PlaceError& place, bool as_bound) {
  const auto steps = static_cast<double>(std::max<std::size_t>(knots.size(), 1) - 1);
  ColorParts largest;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const Rgb &before = knots[k - 1], &behind = knots[k];
    if (before == behind) continue;
    const LeastLight least = least_between(before, behind, k == 1 && place.of_range == 0, as_bound);
    largest.are_bounds &= least.is_bound;
    for (std::size_t c = 0; c < 3; ++c)
      take_largest(parts_between(before[c], behind[c], least.brightest, static_cast<double>(k),
                                 steps, place),
                   largest);
  }
  return largest;
}

ColorParts parts_of(const DrawnComponent& component, const FieldRoundings& roundings,
                    bool as_bound) {
  ColorParts parts;
  if (!component.particles.color.is_absent()) {
    const PlaceError place = error_of_place(component.color, roundings);
    take_largest(parts_of_knots(component.palette.emission, place, as_bound), parts);
    take_largest(parts_of_knots(component.palette.absorption, place, as_bound), parts);
  }
  if (!component.particles.intensity.is_absent()) {
    const PlaceError place = error_of_place(component.intensity, roundings);
    parts.of_brightest += 2 * (place.of_itself + place.of_range);
    parts.of_itself += 2 * (place.of_itself + place.of_range);
    parts.are_bounds &= place.of_range == 0;
  }
  return parts;
}

}  // namespace

ColorParts parts_of_colors(const Frame& frame, const FramePlan& plan) {
  const FieldRoundings roundings = roundings_of(plan);
  ColorParts largest;
  for (const DrawnComponent& component : frame.components)
    take_largest(parts_of(component, roundings, plan.certify), largest);
  return largest;
}

}  // namespace splotchcl
