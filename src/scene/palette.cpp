#include "splotchcl/palette.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {

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
