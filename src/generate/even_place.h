#pragma once

#include <cmath>
#include <cstdint>

#include "generate/random.h"

namespace splotchcl {

// The i-th of a sequence that fills the unit cube evenly, without a lattice's rows: steps
// by powers of the root of x^4 = x + 1.
inline Vec3 even_place(std::uint64_t i, Random& random, double jitter) {
  constexpr double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const double value =
        0.5 + static_cast<double>(i + 1) * steps[axis] + jitter * (random.uniform() - 0.5);
    place.a[axis] = value - std::floor(value);
  }
  return place;
}

}  // namespace splotchcl
