#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "generate/random.h"

namespace splotchcl {

// The eight points of a grid on the periodic unit cube around a place, and the place's
// share in each.
class CellCorners {
 public:
  CellCorners(const Vec3& place, int side) : side_(static_cast<std::size_t>(side)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scaled = place.a[axis] * side;
      const double below = std::floor(scaled);
      const double part = scaled - below;
      parts_[axis] = {1 - part, part};
      const std::size_t row = wrapped(static_cast<int>(below), side);
      rows_[axis] = {row, row + 1 == side_ ? 0 : row + 1};
    }
  }
  std::size_t index(int corner) const {
    return (rows_[0][step(corner, 0)] * side_ + rows_[1][step(corner, 1)]) * side_ +
           rows_[2][step(corner, 2)];
  }
  double weight(int corner) const {
    return parts_[0][step(corner, 0)] * parts_[1][step(corner, 1)] * parts_[2][step(corner, 2)];
  }

 private:
  static std::size_t step(int corner, int axis) {
    return static_cast<std::size_t>(corner >> axis & 1);
  }
  // Most places lie in the cube: a division takes longer than all else.
  static std::size_t wrapped(int cell, int side) {
    const bool is_within = cell >= 0 && cell < side;
    return static_cast<std::size_t>(is_within ? cell : (cell % side + side) % side);
  }

  std::size_t side_;
  std::array<std::array<std::size_t, 2>, 3> rows_{};
  std::array<std::array<double, 2>, 3> parts_{};
};

// A periodic real field on a grid over the unit cube, z fastest, interpolated linearly
// between.
class PeriodicGrid {
 public:
  PeriodicGrid(int side, std::vector<float> values) : side_(side), values_(std::move(values)) {}

  int side() const { return side_; }
  float at(int x, int y, int z) const {
    return values_[(wrapped(x) * static_cast<std::size_t>(side_) + wrapped(y)) *
                       static_cast<std::size_t>(side_) +
                   wrapped(z)];
  }
  double interpolate(const Vec3& place) const {
    const CellCorners corners(place, side_);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      sum += corners.weight(corner) * static_cast<double>(values_[corners.index(corner)]);
    }
    return sum;
  }

 private:
  std::size_t wrapped(int i) const { return static_cast<std::size_t>((i % side_ + side_) % side_); }

  int side_;
  std::vector<float> values_;
};

// Wave numbers are counted per box: n = (x, y, z) stands for exp(2 pi i n.r).
struct WaveNumber {
  int x = 0, y = 0, z = 0;
  double length() const { return std::sqrt(static_cast<double>(x * x + y * y + z * z)); }
};

// A Gaussian random field: a sum of waves |n| <= longest, z >= 0 (the others follow,
// because the field is real).
class RandomWaves {
 public:
  // `power` is the variance of a wave's amplitude by |n|.
  RandomWaves(int longest, const std::function<double(double)>& power, Random& random);

  // The field with each wave's amplitude multiplied by `filter`, on side^3 points.
  PeriodicGrid evaluate(int side,
                        const std::function<std::complex<double>(WaveNumber)>& filter) const;

  // The variance of the field with each amplitude multiplied by `filter` of |n|.
  double variance(const std::function<double(double)>& filter) const;

 private:
  template <typename Visit>
  void for_each_wave(Visit&& visit) const;

  int longest_;
  std::vector<std::complex<double>> amplitudes_;
};

}  // namespace splotchcl
