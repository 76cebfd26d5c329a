#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "splotchcl/vector.h"

namespace splotchcl {

// Random numbers that are the same with every standard library: its engines are fixed by
// the standard, its distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // In [0, 1), with 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double minimum, double maximum) {
    return minimum + (maximum - minimum) * uniform();
  }
  // Mean 0, variance 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(two_pi * uniform());
  }
  Vec3 normal_vector(double sigma) {
    const double x = normal();
    const double y = normal();
    return {{sigma * x, sigma * y, sigma * normal()}};
  }
  // Of length 1.
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double angle = two_pi * uniform();
    const double radius = std::sqrt(1 - z * z);
    return {{radius * std::cos(angle), radius * std::sin(angle), z}};
  }

 private:
  static constexpr double two_pi = 6.283185307179586;
  std::mt19937_64 engine_;
};

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
