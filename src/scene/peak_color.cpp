#include "scene/peak_color.h"

#include <algorithm>
#include <vector>

namespace splotchcl {
namespace {

// Bounds on amplitudes are taken over the whole palette.
double brightest_knot(const std::vector<Rgb>& knots) {
  float brightest = 0;
  for (const Rgb& knot : knots) {
    brightest = std::max(brightest, *std::max_element(knot.begin(), knot.end()));
  }
  return static_cast<double>(brightest);
}

// A per unit weight, of the palette's colours `knots`.
double absorption_of(const DrawnComponent& component, const std::vector<Rgb>& knots) {
  switch (component.absorption.kind) {
    case Absorption::Kind::none:
      return 0;
    case Absorption::Kind::gray:
    case Absorption::Kind::as_emission:
      return component.brightness * brightest_knot(knots);
    case Absorption::Kind::factor:
      return component.absorption.factor * brightest_knot(knots);
  }
  return 0;
}

}  // namespace

double peak_emission(const DrawnComponent& component) {
  return component.brightness * brightest_knot(component.palette.emission);
}

double peak_absorption(const DrawnComponent& component) {
  // Gray absorption is that of the emission.
  const Palette& palette = component.palette;
  const bool own =
      palette.has_own_absorption() && component.absorption.kind != Absorption::Kind::gray;
  return absorption_of(component, own ? palette.absorption : palette.emission);
}

double peak_own_absorption(const DrawnComponent& component) {
  const Palette& palette = component.palette;
  const bool is_gray = component.absorption.kind == Absorption::Kind::gray;
  return palette.has_own_absorption() && !is_gray ? absorption_of(component, palette.absorption)
                                                  : 0;
}

double peak_color(const DrawnComponent& component) {
  return std::max(peak_emission(component), peak_absorption(component));
}

PeakColors::PeakColors(const DrawnComponent& component)
    : own_colors_(component.particles.color_vector),
      peak_(peak_color(component)),
      own_absorption_(peak_own_absorption(component)) {}

double PeakColors::operator()(std::size_t i) const {
  if (own_colors_.is_absent()) return peak_;
  const float own = std::max({own_colors_[3 * i], own_colors_[3 * i + 1], own_colors_[3 * i + 2]});
  return std::max(peak_ * static_cast<double>(own), own_absorption_);
}

}  // namespace splotchcl
