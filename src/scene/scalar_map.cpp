#include "scene/scalar_map.h"

#include <algorithm>
#include <cmath>

#include "splotchcl/palette.h"

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

std::array<double, 3> sample_knots(const std::vector<Rgb>& knots, double position) {
  const double last = static_cast<double>(knots.size() - 1);
  // Not std::clamp: a position that is not a number takes the first knot.
  const double place = position > 0 ? std::min(position, 1.0) * last : 0.0;
  const std::size_t below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, knots.size() - 1);
  const double fraction = place - static_cast<double>(below);
  std::array<double, 3> color;
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = static_cast<double>(knots[below][c]);
    const double b = static_cast<double>(knots[above][c]);
    color[c] = a + fraction * (b - a);
  }
  return color;
}

}  // namespace splotchcl
