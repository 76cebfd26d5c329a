#pragma once

#include <cstdint>

#include "galaxy/light.h"

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

}  // namespace splotchcl
