#include "tree/field_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/scalar_map.h"
#include "tree/sampled_field.h"

namespace splotchcl {
namespace {

constexpr std::size_t upper_halves = 65536;
constexpr std::size_t block = 4096;

float unclamped(float value, const ScalarMap& map) {
  const double place =
      (scaled(static_cast<double>(value), map.scaling) - map.minimum) / (map.maximum - map.minimum);
  return static_cast<float>(place);
}

}  // namespace

FieldPlaces::FieldPlaces(const ScalarMap& map) : map_(map), places_(upper_halves) {
  for_blocks(upper_halves, block, [&](std::size_t first, std::size_t last) {
    for (std::size_t half = first; half < last; ++half)
      places_[half] = unclamped(value_of_ordered(static_cast<std::uint32_t>(half << 16)), map_);
  });
}

float FieldPlaces::operator()(std::uint32_t ordered) const {
  const std::size_t half = ordered >> 16;
  const float from = places_[half], to = places_[std::min(half + 1, upper_halves - 1)];
  if (!std::isfinite(from) || !std::isfinite(to))
    return static_cast<float>(normalized(static_cast<double>(value_of_ordered(ordered)), map_));
  const float part = static_cast<float>(ordered & 0xffffU) * 0x1p-16f;
  return std::clamp(from + part * (to - from), 0.0f, 1.0f);
}

PaletteWay::PaletteWay(const Palette& palette) {
  for (const Rgb& color : palette.emission) {
    Knot knot;
    knot.color = color;
    if (!knots_.empty()) {
      float step = 0;
      for (std::size_t c = 0; c < 3; ++c)
        step = std::max(step, std::abs(color[c] - knots_.back().color[c]));
      knot.way = knots_.back().way + step;
    }
    knots_.push_back(knot);
  }
}

std::pair<std::size_t, float> PaletteWay::below(float place) const {
  if (knots_.size() == 1) return {0, 0.0f};
  const float at = place * static_cast<float>(knots_.size() - 1);
  const auto knot = std::min(static_cast<std::size_t>(at), knots_.size() - 2);
  return {knot, at - static_cast<float>(knot)};
}

std::array<float, 3> PaletteWay::color(float place) const {
  const auto [knot, part] = below(place);
  std::array<float, 3> color = knots_[knot].color;
  if (knot + 1 == knots_.size()) return color;
  for (std::size_t c = 0; c < 3; ++c)
    color[c] += part * (knots_[knot + 1].color[c] - color[c]);
  return color;
}

float PaletteWay::way(float place) const {
  const auto [knot, part] = below(place);
  const float from = knots_[knot].way;
  return knot + 1 == knots_.size() ? from : from + part * (knots_[knot + 1].way - from);
}

float PaletteWay::spread(float a, float b) const {
  return std::abs(way(a) - way(b));
}

}  // namespace splotchcl
