#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "splotchcl/frame.h"

namespace splotchcl {

// A field's way to [0, 1] for many values: between values whose upper sixteen bits follow each
// other it is taken as straight, which errs by less than 1e-5 of an e-fold.
class FieldPlaces {
 public:
  explicit FieldPlaces(const ScalarMap& map);
  // Of ordered_value().
  float operator()(std::uint32_t ordered) const;

 private:
  ScalarMap map_;
  std::vector<float> places_;  // before they are clamped
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
  Step step(float place) const;
  std::array<float, 3> color(float place) const { return step(place).color; }

 private:
  std::vector<Step> knots_;
};

}  // namespace splotchcl
