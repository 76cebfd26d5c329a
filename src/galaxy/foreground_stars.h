#pragma once

#include <cstdint>

#include "splotchcl/image.h"

namespace splotchcl {

struct StarCriteria {
  double contrast = 2.5;   // of a star against the median around it
  double least_light = 0;  // above that median
  int center_x = 0, center_y = 0;
  double protected_radius = 0;  // around the centre: a galaxy's nucleus is a point, too
};

// Replaces points of light by the median of what surrounds them: pixels far brighter than the
// median of a ring around them, unless both red and blue exceed green, as in the clouds that
// shine in hydrogen's red line among young stars. Returns how many pixels were replaced.
std::uint64_t remove_foreground_stars(Image& picture, const StarCriteria& criteria);

}  // namespace splotchcl
