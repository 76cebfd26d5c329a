#include "splotchcl/palette.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {

std::array<double, 3> sample_knots(const std::vector<Rgb>& knots, double position) {
  const double last = static_cast<double>(knots.size() - 1);
  const double place = std::clamp(position, 0.0, 1.0) * last;
  const std::size_t below = static_cast<std::size_t>(std::min(std::floor(place), last));
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
