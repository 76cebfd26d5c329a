#include "tree/field_colors.h"

#include <algorithm>
#include <cmath>

#include "parallel/for_blocks.h"
#include "scene/hash.h"
#include "scene/scalar_map.h"

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

namespace {

void add(const ScalarMap& map, WordHash& hash) {
  hash.add(static_cast<std::uint64_t>(map.scaling));
  hash.add(map.minimum);
  hash.add(map.maximum);
}

}  // namespace

std::uint64_t ColorRule::key() const {
  WordHash hash;
  for (const int field : {color, intensity})
    hash.add(static_cast<std::uint64_t>(field + 1));
  if (color >= 0) add(color_map, hash);
  if (intensity >= 0) add(intensity_map, hash);
  for (const Rgb& knot : palette.emission) {
    for (const float channel : knot)
      hash.add(static_cast<double>(channel));
  }
  return hash.value();
}

ParticleColors::ParticleColors(const ColorRule& rule)
    : color_(rule.color), intensity_(rule.intensity), palette_(rule.palette) {
  if (color_ >= 0) places_.emplace(rule.color_map);
  if (intensity_ >= 0) intensities_.emplace(rule.intensity_map);
}

std::array<float, 3> ParticleColors::operator()(const MemberValues& values) const {
  const auto ordered = [&values](int field) {
    return field < 0 ? 0 : ordered_value(values[static_cast<std::size_t>(field)]);
  };
  std::array<float, 3> color = step(ordered(color_)).color;
  for (float& channel : color)
    channel *= intensity(ordered(intensity_));
  return color;
}

}  // namespace splotchcl
