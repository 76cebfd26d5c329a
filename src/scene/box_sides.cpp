#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "splotchcl/periodic.h"

namespace splotchcl {
namespace {

// In as few digits as tell it from all others.
std::string shortest_text(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace

double BoxSides::longest() const {
  return std::max({sides_.a[0], sides_.a[1], sides_.a[2]});
}

bool BoxSides::is_cube() const {
  return sides_.a[0] == sides_.a[1] && sides_.a[0] == sides_.a[2];
}

bool BoxSides::are_lengths() const {
  return std::all_of(sides_.a, sides_.a + 3,
                     [](double side) { return side > 0 && std::isfinite(side); });
}

std::string BoxSides::text() const {
  if (is_cube()) return shortest_text(sides_.a[0]);
  return shortest_text(sides_.a[0]) + " x " + shortest_text(sides_.a[1]) + " x " +
         shortest_text(sides_.a[2]);
}

std::optional<BoxSides> box_of(const std::vector<double>& sides) {
  if (sides.size() != 1 && sides.size() != 3) return std::nullopt;
  const BoxSides box =
      sides.size() == 1 ? BoxSides(sides[0]) : BoxSides(Vec3{{sides[0], sides[1], sides[2]}});
  return box.are_lengths() ? std::optional(box) : std::nullopt;
}

double nearest_image(double d, double side) {
  // Most lie there already, and a call to round each would take longer than to read it.
  if (std::abs(d) <= 0.5 * side) return d;
  return d - side * std::nearbyint(d / side);
}

}  // namespace splotchcl
