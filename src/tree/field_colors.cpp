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

FieldPlaces::FieldPlaces(const ScalarMap& map) : map_(map), places_(upper_halves + 1) {
  for_blocks(upper_halves, block, [&](std::size_t first, std::size_t last) {
    for (std::size_t half = first; half < last; ++half)
      places_[half] = unclamped(value_of_ordered(static_cast<std::uint32_t>(half << 16)), map_);
  });
  places_.back() = places_[upper_halves - 1];
}

float FieldPlaces::exact(std::uint32_t ordered) const {
  return static_cast<float>(normalized(static_cast<double>(value_of_ordered(ordered)), map_));
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

}  // namespace splotchcl
