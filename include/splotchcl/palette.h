#pragma once

#include <array>
#include <string>
#include <vector>

namespace splotchcl {

using Rgb = std::array<float, 3>;  // linear intensity per channel, 1 = display white

// Colours at evenly spaced knots over the scalar's range [0, 1], linear between
// them and constant outside. A palette has at least one knot.
struct Palette {
  std::string name;             // as a scene says it, or the file's
  std::vector<Rgb> emission;    // values >= 0
  std::vector<Rgb> absorption;  // with knots of its own number; empty: the same as emission

  bool has_own_absorption() const { return !absorption.empty(); }
};

// Linear interpolation between at least one knot, in double precision; `position` is clamped to
// [0, 1], and not-a-number is 0.
std::array<double, 3> sample_knots(const std::vector<Rgb>& knots, double position);

}  // namespace splotchcl
