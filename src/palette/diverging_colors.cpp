#include "palette/diverging_colors.h"

#include <algorithm>
#include <cmath>

#include "palette/lab_colors.h"

namespace splotchcl {
namespace {

constexpr double pi = 3.14159265358979323846;

// L*a*b* in polar coordinates.
struct Msh {
  double magnitude = 0, saturation = 0, hue = 0;

  bool is_gray() const { return saturation <= 0.05; }
};

Msh msh_of(const Rgb& color) {
  const Three lab = lab_of(color);
  Msh msh;
  msh.magnitude = std::hypot(lab[0], lab[1], lab[2]);
  msh.saturation = msh.magnitude > 1e-3 ? std::acos(lab[0] / msh.magnitude) : 0;
  msh.hue = msh.saturation > 1e-3 ? std::atan2(lab[2], lab[1]) : 0;
  return msh;
}

Rgb color_of_msh(const Msh& msh) {
  const double chroma = msh.magnitude * std::sin(msh.saturation);
  return color_of_lab({msh.magnitude * std::cos(msh.saturation), chroma * std::cos(msh.hue),
                       chroma * std::sin(msh.hue)});
}

double angle_between(double a, double b) {
  const double angle = std::fmod(std::abs(a - b), 2 * pi);
  return std::min(angle, 2 * pi - angle);
}

// Of a gray that is joined to a color: turned so that the way between them looks even.
double hue_of_gray(const Msh& color, double magnitude) {
  if (color.magnitude >= magnitude) return color.hue;
  const double turn = color.saturation *
                      std::sqrt(magnitude * magnitude - color.magnitude * color.magnitude) /
                      (color.magnitude * std::sin(color.saturation));
  return color.hue > -pi / 3 ? color.hue + turn : color.hue - turn;
}

Rgb color_between(const Rgb& before, const Rgb& after, double part) {
  Msh a = msh_of(before), b = msh_of(after);
  const bool are_far_apart = !a.is_gray() && !b.is_gray() && angle_between(a.hue, b.hue) > pi / 3;
  if (are_far_apart) {
    const Msh white = {std::max({a.magnitude, b.magnitude, 88.0}), 0, 0};
    const bool is_first_half = part < 0.5;
    (is_first_half ? b : a) = white;
    part = is_first_half ? 2 * part : 2 * part - 1;
  }
  if (a.is_gray() && !b.is_gray()) a.hue = hue_of_gray(b, a.magnitude);
  if (b.is_gray() && !a.is_gray()) b.hue = hue_of_gray(a, b.magnitude);
  return color_of_msh({a.magnitude + part * (b.magnitude - a.magnitude),
                       a.saturation + part * (b.saturation - a.saturation),
                       a.hue + part * (b.hue - a.hue)});
}

}  // namespace

std::vector<PlacedColor> joined_over_white(const std::vector<PlacedColor>& colors) {
  return joined(colors, color_between);
}

}  // namespace splotchcl
