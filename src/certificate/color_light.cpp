#include "certificate/color_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "parallel/for_blocks.h"
#include "scene/plan/light_structure.h"
#include "scene/scalar_map.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// What a part of the deepest channel's depth does to the faintest: dI / dx = q - I. Light that has
// come close to its source tells no more of how deep it is.
double of_depth(double faintest, double brightest, double deepest, double source, double contrast) {
  const double least = std::min(std::abs(source - faintest), std::abs(source - brightest));
  const double most = std::max(std::abs(source - faintest), std::abs(source - brightest));
  constexpr double close = 1e-4;
  const double depth =
      least > close * contrast ? std::min(std::log(contrast / least), deepest) : deepest;
  return std::max(depth, 0.0) * most / std::max(1.0, faintest);
}

// Between two knots as at one of them: both are quotients of linear functions.
double tint_of(const Rgb& absorption) {
  const auto [least, most] = std::minmax({absorption[0], absorption[1], absorption[2]});
  return most > 0 ? 1 - static_cast<double>(least) / static_cast<double>(most) : 0;
}

// By which part of its depth the channel that matter absorbs most is deeper than another one, at
// most.
double tint_of(const Frame& frame) {
  double most = 0;
  for (const DrawnComponent& component : frame.components) {
    if (component.absorption.kind == Absorption::Kind::none) continue;
    if (!component.particles.color_vector.is_absent()) return 1;
    const Palette& palette = component.palette;
    for (const Rgb& color : palette.has_own_absorption() ? palette.absorption : palette.emission)
      most = std::max(most, tint_of(color));
  }
  return most;
}

constexpr std::size_t rows_at_once = 16;

float brightest_of_row(const Image& image, int y) {
  float most[3] = {0, 0, 0};
  const float* pixel = image.at(0, y);
  for (int x = 0; x < image.width; ++x, pixel += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      most[c] = pixel[c] > most[c] ? pixel[c] : most[c];
  }
  return std::max({most[0], most[1], most[2]});
}

}  // namespace

ColorLight::ColorLight(const Image& image, const std::vector<float>& depths, const Frame& frame,
                       const FramePlan& plan)
    : image_(image),
      depths_(depths),
      parts_(parts_of_colors(frame, plan)),
      light_(plan.light),
      source_(plan.source[0]),
      contrast_(plan.source[0] + brightest_background(frame)),
      tinted_(tint_of(frame)) {}

// Of pixels that are no brighter and no deeper than that.
double ColorLight::at_most(double brightest, double deepest) const {
  return light_ == LightPlan::proportional ? std::max(deepest, 0.0) * contrast_ : brightest;
}

bool ColorLight::are_within(double error) const {
  const double deepest =
      depths_.empty() ? 0 : static_cast<double>(*std::max_element(depths_.begin(), depths_.end()));
  std::vector<float> rows(static_cast<std::size_t>(image_.height));
  if (light_ == LightPlan::emission) {
    for_blocks(rows.size(), rows_at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t y = first; y < last; ++y)
        rows[y] = brightest_of_row(image_, static_cast<int>(y));
    });
  }
  const double brightest =
      rows.empty() ? 0 : static_cast<double>(*std::max_element(rows.begin(), rows.end()));
  return parts_.of_brightest * at_most(brightest, deepest) <= error;
}

double ColorLight::of_pixel(const float* pixel, double deepest) const {
  const auto faintest = static_cast<double>(std::min({pixel[0], pixel[1], pixel[2]}));
  const auto brightest = static_cast<double>(std::max({pixel[0], pixel[1], pixel[2]}));
  if (light_ != LightPlan::proportional) return brightest / std::max(1.0, faintest);
  return brightest > 0 ? of_depth(faintest, brightest, deepest, source_, contrast_) : 0;
}

template <class OfPixel>
double ColorLight::largest_in(std::size_t block, const OfPixel& of_pixel) const {
  const PixelBlock pixels = pixels_of_block(block, BlockErrors::blocks_along(image_.width));
  double largest = 0;
  for (int y = pixels.y0; y < std::min(pixels.y1, image_.height); ++y) {
    for (int x = pixels.x0; x < std::min(pixels.x1, image_.width); ++x)
      largest = std::max(largest, of_pixel(image_.at(x, y)));
  }
  return largest;
}

double ColorLight::depth_of(std::size_t block) const {
  constexpr double unknown = 88;
  return depths_.empty() ? unknown : static_cast<double>(depths_[block]);
}

// The brightest channels of all splats together are no more than all channels of the pixel.
double ColorLight::bound_of_pixel(const float* pixel, double deepest) const {
  std::array<double, 3> channels{};
  std::copy_n(pixel, 3, channels.begin());
  const auto [faintest, brightest] = std::minmax_element(channels.begin(), channels.end());
  const double allowed = std::max(1.0, *faintest);
  if (light_ == LightPlan::proportional)
    return 3 * deepest * std::max(std::abs(source_ - *faintest), std::abs(source_ - *brightest)) /
           allowed;
  const double all = (channels[0] + channels[1] + channels[2]) / allowed;
  if (light_ == LightPlan::emission) return all;
  // Of a layer behind and within a depth of x its most absorbed channel shows no less than
  // exp(-x) / (1 + x), and another one exp(tinted_ x) times as much at most. What a layer errs by
  // in depth changes a pixel by that part of what lies behind, and by half of it of the layer.
  return std::exp(tinted_ * deepest) * (1 + deepest) * all + 1.5 * 3 * deepest;
}

double ColorLight::bound_in_block(std::size_t block, const BlockLight& light) const {
  const double deepest = depth_of(block);
  const double most =
      largest_in(block, [&](const float* pixel) { return bound_of_pixel(pixel, deepest); });
  // A part that may be infinite.
  const double of_itself = light.parts > 0 ? parts_.of_itself * light.parts : 0;
  return std::min(of_itself, parts_.of_brightest * most);
}

// Opaque layers of one channel hide how deep they are, and what others let through of them.
double ColorLight::in_block(std::size_t block, const BlockLight& light, double depth,
                            double negligible) const {
  constexpr double opaque = 10;
  // Which may be infinite.
  const double of_itself = light.parts > 0 ? parts_.of_itself * light.parts : 0;
  if (of_itself <= negligible) return of_itself;
  const double deepest = depth_of(block);
  double most = at_most(light.most, deepest);
  if (parts_.of_brightest * most > negligible)
    most = largest_in(block, [&](const float* pixel) { return of_pixel(pixel, deepest); });
  if (light_ == LightPlan::ordered)
    most = most * (1 + light.behind) + (deepest > opaque ? std::max(deepest, depth) : 0);
  return std::min(of_itself, parts_.of_brightest * most);
}

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
