#include "palette/lab_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

// IEC 61966-2-1.
constexpr std::array<Three, 3> xyz_of_rgb = {{{0.4124564, 0.3575761, 0.1804375},
                                              {0.2126729, 0.7151522, 0.0721750},
                                              {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<Three, 3> rgb_of_xyz = {{{3.2404542, -1.5371385, -0.4985314},
                                              {-0.9692660, 1.8760108, 0.0415560},
                                              {0.0556434, -0.2040259, 1.0572252}}};
constexpr Three white_point = {0.95047, 1, 1.08883};
// CIE 15: below it the cube root is a line.
constexpr double linear_end = 6.0 / 29;

Three times(const std::array<Three, 3>& matrix, const Three& v) {
  Three result = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result[i] += matrix[i][j] * v[j];
  }
  return result;
}

double linear_of_display(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double display_of_linear(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double root_of(double ratio) {
  if (ratio > linear_end * linear_end * linear_end) return std::cbrt(ratio);
  return ratio / (3 * linear_end * linear_end) + 4.0 / 29;
}

double ratio_of(double root) {
  if (root > linear_end) return root * root * root;
  return 3 * linear_end * linear_end * (root - 4.0 / 29);
}

}  // namespace

Three lab_of(const Rgb& color) {
  Three light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = linear_of_display(static_cast<double>(color[c]));
  const Three xyz = times(xyz_of_rgb, light);
  const double x = root_of(xyz[0] / white_point[0]), y = root_of(xyz[1] / white_point[1]),
               z = root_of(xyz[2] / white_point[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Rgb color_of_lab(const Three& lab) {
  const double y = (lab[0] + 16) / 116, x = y + lab[1] / 500, z = y - lab[2] / 200;
  const Three light = times(rgb_of_xyz, {white_point[0] * ratio_of(x), white_point[1] * ratio_of(y),
                                         white_point[2] * ratio_of(z)});
  Rgb color;
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<float>(display_of_linear(std::clamp(light[c], 0.0, 1.0)));
  return color;
}

std::vector<PlacedColor> joined(const std::vector<PlacedColor>& colors, const Between& between) {
  constexpr int steps = 64;
  std::vector<PlacedColor> all;
  for (std::size_t i = 0; i + 1 < colors.size(); ++i) {
    const PlacedColor &before = colors[i], &after = colors[i + 1];
    all.push_back(before);
    for (int step = 1; step < steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      all.push_back({before.place + part * (after.place - before.place),
                     between(before.color, after.color, part)});
    }
  }
  if (!colors.empty()) all.push_back(colors.back());
  return all;
}

std::vector<PlacedColor> joined_in_lab(const std::vector<PlacedColor>& colors) {
  return joined(colors, [](const Rgb& before, const Rgb& after, double part) {
    const Three a = lab_of(before), b = lab_of(after);
    Three lab;
    for (std::size_t c = 0; c < 3; ++c)
      lab[c] = a[c] + part * (b[c] - a[c]);
    return color_of_lab(lab);
  });
}

}  // namespace splotchcl
