#include "scene/scalar_map.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {

double scaled(double value, Scaling scaling) {
  switch (scaling) {
    case Scaling::linear:
      return value;
    case Scaling::log:
      return std::log10(value);
    case Scaling::asinh:
      return std::asinh(value);
  }
  return value;
}

double unscaled(double value, Scaling scaling) {
  switch (scaling) {
    case Scaling::linear:
      return value;
    case Scaling::log:
      return std::pow(10, value);
    case Scaling::asinh:
      return std::sinh(value);
  }
  return value;
}

std::optional<double> least_before_scaling(const ScalarMap& map) {
  const double least = unscaled(map.minimum, map.scaling);
  switch (map.scaling) {
    case Scaling::linear:
      return std::nullopt;
    case Scaling::log: {
      // (v - least) / least, whose parts are floats of full precision.
      constexpr double smallest = 1.2e-38, largest = 3e38, widest = 37;
      const bool fits =
          least >= smallest && least <= largest && map.maximum - map.minimum <= widest;
      return fits ? std::optional(least) : std::nullopt;
    }
    case Scaling::asinh: {
      constexpr double farthest = 1e18;  // squares are floats
      const double most = unscaled(map.maximum, map.scaling);
      const bool fits = std::abs(least) <= farthest && std::abs(most) <= farthest;
      return fits ? std::optional(least) : std::nullopt;
    }
  }
  return std::nullopt;
}

double normalized(double value, const ScalarMap& map) {
  const double v = scaled(value, map.scaling);
  if (!std::isfinite(v) || map.maximum == map.minimum) return 0;
  return std::clamp((v - map.minimum) / (map.maximum - map.minimum), 0.0, 1.0);
}

}  // namespace splotchcl
