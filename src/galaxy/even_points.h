#pragma once

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "generate/random.h"

// Points that are spread more evenly than at random, so that light which is even in the picture is
// even from every side: numbers of random points vary by their root.
namespace splotchcl {

// Where a standard normal variate has this part, in [0, 1), of its mass below.
inline double normal_quantile(double part) {
  constexpr double least = 1e-12;
  // Long doubles would be slow, and not the same on every machine.
  using boost::math::policies::policy;
  const policy<boost::math::policies::promote_double<false>> in_double;
  return M_SQRT2 * boost::math::erf_inv(2 * std::clamp(part, least, 1 - least) - 1, in_double);
}

// How far, of the cube's side, points of an even sequence of so many are moved: half of what lies
// between them.
inline double jitter_between(std::uint64_t count) {
  return 0.5 / std::cbrt(static_cast<double>(count));
}

// Of so many points for each pixel of a picture.
class PointsOfPixels {
 public:
  explicit PointsOfPixels(int per_pixel) : per_pixel_(per_pixel) {}

  // To be called for each pixel before its points.
  void begin(int x, int y, Random& random) {
    x_ = x;
    y_ = y;
    shift_ = {random.uniform(), random.uniform()};
  }
  // In pixels from the picture's left and top.
  std::array<double, 2> place(int point) const {
    // Steps by powers of the root of x^3 = x + 1.
    return {x_ + fraction(shift_[0] + point * 0.7548776662466927),
            y_ + fraction(shift_[1] + point * 0.5698402909980532)};
  }
  // In [0, 1): a pixel's points lie in layers, those of its neighbours between them.
  double layer(int point, Random& random) const {
    return fraction(x_ * 0.7548776662466927 + y_ * 0.5698402909980532 +
                    (point + random.uniform()) / per_pixel_);
  }

 private:
  static double fraction(double value) { return value - std::floor(value); }

  int per_pixel_;
  int x_ = 0, y_ = 0;
  std::array<double, 2> shift_ = {0, 0};
};

}  // namespace splotchcl
