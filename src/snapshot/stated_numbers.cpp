#include "snapshot/stated_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace splotchcl {

double hubble_parameter_of(double stated, std::vector<std::string>& notes) {
  constexpr double largest = 10;
  if (!(stated > 0) || !std::isfinite(stated)) return 0;
  if (stated <= largest) return stated;
  notes.push_back(fmt::format(
      "the Hubble parameter in the file, {}, is taken for H0 in km/s/Mpc: h is {:.6g} in units",
      stated, stated / 100));
  return stated / 100;
}

std::optional<BoxSides> box_stated(const std::vector<double>& sides,
                                   std::vector<std::string>& notes) {
  const std::optional<BoxSides> box = box_of(sides);
  const bool says_none =
      std::all_of(sides.begin(), sides.end(), [](double side) { return side == 0; });
  if (!box && !says_none) {
    notes.push_back(fmt::format(
        "the box in the file, {}, is not of one length above 0, or three: nothing is periodic; "
        "periodic.box may say what it is",
        fmt::join(sides, " x ")));
  }
  return box;
}

}  // namespace splotchcl
