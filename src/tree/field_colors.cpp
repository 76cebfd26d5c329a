#include "tree/field_colors.h"

#include <algorithm>
#include <cmath>

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
    Step knot;
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

PaletteWay::Step PaletteWay::step(float place) const {
  if (knots_.size() == 1) return knots_.front();
  const float at = place * static_cast<float>(knots_.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), knots_.size() - 2);
  const float part = at - static_cast<float>(below);
  Step step = knots_[below];
  const Step& next = knots_[below + 1];
  for (std::size_t c = 0; c < 3; ++c)
    step.color[c] += part * (next.color[c] - step.color[c]);
  step.way += part * (next.way - step.way);
  return step;
}

}  // namespace splotchcl
