#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "splotchcl/frame.h"
#include "tree/sampled_field.h"

namespace splotchcl {

// A field's way to [0, 1] for many values: between values whose upper sixteen bits follow each
// other it is taken as straight, which errs by less than 1e-5 of an e-fold.
class FieldPlaces {
 public:
  explicit FieldPlaces(const ScalarMap& map);
  // Of ordered_value().
  float operator()(std::uint32_t ordered) const {
    const std::size_t half = ordered >> 16;
    const float from = places_[half], to = places_[half + 1];
    const float part = static_cast<float>(ordered & 0xffffU) * 0x1p-16f;
    const float place = from + part * (to - from);
    return std::isfinite(place) ? std::clamp(place, 0.0f, 1.0f) : exact(ordered);
  }

 private:
  float exact(std::uint32_t ordered) const;

  ScalarMap map_;
  std::vector<float> places_;  // before they are clamped, the last one twice
};

// A palette's emission, and how long its way is.
class PaletteWay {
 public:
  explicit PaletteWay(const Palette& palette);
  // Colors between two places lie apart in any channel by at most the way between them.
  struct Step {
    std::array<float, 3> color{};
    float way = 0;  // from the first knot
  };
  Step step(float place) const {
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
  std::array<float, 3> color(float place) const { return step(place).color; }

 private:
  std::vector<Step> knots_;
};

// What makes colors of a particle's fields, in a scene whose numbers are decided.
struct ColorRule {
  int color = -1, intensity = -1;  // among the tree's fields; -1: none is used
  ScalarMap color_map, intensity_map;
  Palette palette;

  bool uses_fields() const { return color >= 0 || intensity >= 0; }
  // Of rules that give other colors another.
  std::uint64_t key() const;
};

// The colors that a rule gives.
class ParticleColors {
 public:
  explicit ParticleColors(const ColorRule& rule);
  std::array<float, 3> operator()(const MemberValues& values) const;
  // Of ordered_value() of the field of its kind; the palette's first, and 1, where none is used.
  PaletteWay::Step step(std::uint32_t ordered) const {
    return palette_.step(places_ ? (*places_)(ordered) : 0);
  }
  float intensity(std::uint32_t ordered) const {
    return intensities_ ? (*intensities_)(ordered) : 1;
  }

 private:
  int color_, intensity_;  // fields, as the rule has them
  PaletteWay palette_;
  std::optional<FieldPlaces> places_, intensities_;
};

}  // namespace splotchcl
