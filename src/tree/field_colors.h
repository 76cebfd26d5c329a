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
  std::array<float, 3> color(float place) const;
  // How far colors between two places may lie apart in any channel, at most.
  float spread(float a, float b) const;

 private:
  struct Knot {
    std::array<float, 3> color{};
    float way = 0;  // from the first knot
  };
  float way(float place) const;
  // The knot below a place, and how far it is to the next.
  std::pair<std::size_t, float> below(float place) const;

  std::vector<Knot> knots_;
};

}  // namespace splotchcl
