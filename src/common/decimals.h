#pragma once

#include <cmath>

namespace splotchcl {

// How many digits after the point write `size` with so many digits in all; below zero for
// digits before the point. `size` must not be 0.
inline double decimals_for(double size, int digits) {
  return digits - 1 - std::floor(std::log10(std::abs(size)));
}

// By whole numbers, so that the result prints with no more digits than asked for.
inline double round_to_decimals(double value, double decimals) {
  const double scale = std::pow(10, std::abs(decimals));
  const double rounded =
      decimals > 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return rounded + 0.0;  // not -0
}

}  // namespace splotchcl
