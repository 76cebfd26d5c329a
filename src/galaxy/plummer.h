#pragma once

#include <cmath>

#include "generate/random.h"

namespace splotchcl {

// The radius that holds a part, in (0, 1], of a Plummer sphere of radius 1, cut at 8.
inline double plummer_radius(double part) {
  constexpr double farthest = 8;
  const double all = std::pow(1 + 1 / (farthest * farthest), -1.5);
  return 1 / std::sqrt(std::pow(all * part, -2.0 / 3) - 1);
}
// That of a random part.
inline double plummer_radius(Random& random) {
  return plummer_radius(1 - random.uniform());
}

// Of length 1, at a right angle to a place, else in any direction.
inline Vec3 axis_across(const Vec3& place, Random& random) {
  const Vec3 axis = boost::qvm::cross(place, random.direction());
  const double length = boost::qvm::mag(axis);
  return length > 0 ? axis / length : Vec3{{0, 0, 1}};
}

// A factor on a star's light: log-normal with mean 1.
inline double star_brightness(Random& random, double spread = 0.8) {
  return std::exp(spread * random.normal() - spread * spread / 2);
}

}  // namespace splotchcl
