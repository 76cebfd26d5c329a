#include "palette/placed_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

bool are_even(const std::vector<PlacedColor>& colors) {
  constexpr double rounding = 1e-3;  // of a step
  const double first = colors.front().place;
  const double step = (colors.back().place - first) / static_cast<double>(colors.size() - 1);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double expected = first + step * static_cast<double>(i);
    if (std::abs(colors[i].place - expected) > rounding * step) return false;
  }
  return true;
}

Rgb color_at(const std::vector<PlacedColor>& colors, double place) {
  const auto after = std::upper_bound(
      colors.begin(), colors.end(), place,
      [](double wanted, const PlacedColor& color) { return wanted < color.place; });
  if (after == colors.begin()) return colors.front().color;
  if (after == colors.end()) return colors.back().color;
  const PlacedColor& before = *std::prev(after);
  const auto part = static_cast<float>((place - before.place) / (after->place - before.place));
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c)
    color[c] = before.color[c] + part * (after->color[c] - before.color[c]);
  return color;
}

}  // namespace

std::vector<Rgb> even_knots(const std::vector<PlacedColor>& colors) {
  constexpr std::size_t many = 1024;
  std::vector<Rgb> knots;
  const double first = colors.front().place, last = colors.back().place;
  if (colors.size() == 1 || !(last > first) || are_even(colors)) {
    for (const PlacedColor& color : colors)
      knots.push_back(color.color);
    return knots;
  }
  for (std::size_t i = 0; i < many; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(many - 1);
    knots.push_back(color_at(colors, first + part * (last - first)));
  }
  return knots;
}

}  // namespace splotchcl
