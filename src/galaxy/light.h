#pragma once

#include <array>

#include "splotchcl/image.h"

namespace splotchcl {

using Light = std::array<double, 3>;  // linear red, green, blue

inline Light light_at(const Image& image, int x, int y) {
  const float* const pixel = image.at(x, y);
  return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
          static_cast<double>(pixel[2])};
}

inline double mean(const Light& light) {
  return (light[0] + light[1] + light[2]) / 3;
}

inline Light operator*(double factor, const Light& light) {
  return {factor * light[0], factor * light[1], factor * light[2]};
}

}  // namespace splotchcl
