#pragma once

#include <cstdint>

#include "galaxy/light.h"
#include "splotchcl/image.h"

namespace splotchcl {

// What a picture shows where there is no galaxy.
struct Sky {
  Light level = {0, 0, 0};
  double noise = 0;  // standard deviation of a pixel's mean over the channels
};

// From the picture's border: the median of each channel, and the median distance from it.
Sky measure_sky(const Image& picture);

// The same picture with the sky's light taken away, none below 0.
Image without_sky(const Image& picture, const Sky& sky);

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
