#include "scene/plan/light_structure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace splotchcl {
namespace {

using Kind = Absorption::Kind;

bool all_of_kind(const Frame& frame, Kind kind) {
  return std::all_of(frame.components.begin(), frame.components.end(),
                     [kind](const DrawnComponent& c) { return c.absorption.kind == kind; });
}

// The one E / A of all particles of a component that absorbs by the colours by which it emits, as
// the scene's own numbers say it. Nothing where it may differ from particle to particle.
std::optional<double> source_of_all(const DrawnComponent& component) {
  if (component.palette.has_own_absorption()) return std::nullopt;
  if (component.absorption.kind == Kind::as_emission) return 1;
  if (component.absorption.kind != Kind::factor) return std::nullopt;
  // Sums are of A w, and E is as many times as much: of more single precision holds too little of
  // one of them.
  constexpr double largest = 1e31;
  const double source = component.brightness / component.absorption.factor;
  return source >= 1 / largest && source <= largest ? std::optional(source) : std::nullopt;
}

// 0.6 / 0.2 is 3, whatever divisions round to: pictures err by as little.
bool is_same_source(double a, double b) {
  constexpr double roundings = 1e-14;
  return std::abs(a - b) <= roundings * std::max(a, b);
}

std::optional<double> common_source(const Frame& frame) {
  std::optional<double> common;
  for (const DrawnComponent& component : frame.components) {
    const std::optional<double> source = source_of_all(component);
    if (!source || (common && !is_same_source(*common, *source))) return std::nullopt;
    if (!common) common = source;
  }
  return common;
}

// Between two knots of both palettes E and A are linear, so E / A is largest at a knot.
double brightest_quotient(const Palette& palette) {
  double largest = 0;
  for (const std::vector<Rgb>* knots : {&palette.emission, &palette.absorption}) {
    for (std::size_t k = 0; k < knots->size(); ++k) {
      const double place =
          static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(knots->size() - 1, 1));
      const auto emission = sample_knots(palette.emission, place);
      const auto absorption = sample_knots(palette.absorption, place);
      for (std::size_t c = 0; c < 3; ++c) {
        if (emission[c] > 0) largest = std::max(largest, emission[c] / absorption[c]);
      }
    }
  }
  return largest;
}

}  // namespace

LightStructure find_light_structure(const Frame& frame) {
  if (all_of_kind(frame, Kind::none)) return {LightPlan::emission, {1, 1, 1}};
  LightStructure structure;
  if (const std::optional<double> source = common_source(frame)) {
    structure.light = LightPlan::proportional;
    structure.source.fill(*source);
  }
  return structure;
}

bool has_own_colors(const DrawnComponent& component) {
  return !component.particles.color_vector.is_absent();
}

double brightest_background(const Frame& frame) {
  if (!frame.background_image) {
    return *std::max_element(frame.background.begin(), frame.background.end());
  }
  float brightest = 0;
  const std::vector<float>& pixels = frame.background_image->pixels;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    brightest = std::max({brightest, pixels[i], pixels[i + 1], pixels[i + 2]});
  }
  return static_cast<double>(brightest);
}

double brightest_source(const DrawnComponent& component) {
  if (component.absorption.kind == Kind::none) return std::numeric_limits<double>::infinity();
  if (component.absorption.kind == Kind::gray) return 1;
  const double factor = component.absorption.kind == Kind::factor
                            ? component.brightness / component.absorption.factor
                            : 1;
  if (!component.palette.has_own_absorption()) return factor;
  // Colors of the particles' own have no bound that is known without reading them all.
  if (has_own_colors(component)) return std::numeric_limits<double>::infinity();
  return factor * brightest_quotient(component.palette);
}

double brightest_source(const Frame& frame) {
  double brightest = 0;
  for (const DrawnComponent& component : frame.components) {
    brightest = std::max(brightest, brightest_source(component));
  }
  return brightest;
}

}  // namespace splotchcl
