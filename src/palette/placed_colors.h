#pragma once

#include <vector>

#include "splotchcl/palette.h"

namespace splotchcl {

// A color and where it is.
struct PlacedColor {
  double place = 0;
  Rgb color;
};

// Knots at even steps from the first place to the last, which must not decrease: the colors
// themselves where they are so, else many between them.
std::vector<Rgb> even_knots(const std::vector<PlacedColor>& colors);

}  // namespace splotchcl
