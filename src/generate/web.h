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

// Matter that has collapsed: the ball of this radius around `birthplace` in the early,
// even universe (lengths in units of the box).
struct Halo {
  Vec3 birthplace;
  double birth_radius = 0;
  Vec3 center;  // where it is today
};

// The density's contrast, grown to today, averaged over balls of a radius.
using SmoothedContrast = std::function<PeriodicGrid(double radius)>;

// Peaks of the averaged contrast above that of a collapse, largest balls first; each
// starts outside the balls found before it.
std::vector<Halo> find_haloes(const SmoothedContrast& contrast, double largest_radius,
                              double smallest_radius);

// Which halo's ball a place of the early universe belongs to.
class HaloMap {
 public:
  HaloMap(const std::vector<Halo>& haloes, int side);
  static constexpr int none = -1;
  int at(const Vec3& birthplace) const;  // an index of `haloes`, or none

 private:
  std::size_t cell_of(const Vec3& place) const;

  int side_;
  std::vector<int> halo_;
};

// From a to b, the short way round a periodic box of side 1.
Vec3 periodic_difference(const Vec3& a, const Vec3& b);

// Cold dark matter in a flat universe, with lengths in kpc/h and masses in 1e10 solar
// masses/h.
namespace cosmology {
constexpr double matter = 0.3, baryons = 0.045;  // in units of the critical density
constexpr double critical_density = 2.77536e-8;  // per (kpc/h)^3
constexpr double sigma_8 = 0.9;                  // of the contrast in balls of 8000 kpc/h
constexpr double hubble = 0.1;                   // km/s per kpc/h
constexpr double growth_rate = 0.51;             // matter^0.55, of today's linear growth
}  // namespace cosmology

// Where matter of the early, even universe has gone today, in linear theory: displacements
// along a Gaussian random field (Zeldovich's approximation). Lengths in units of the box.
class Web {
 public:
  Web(double box_size, Random& random);

  Vec3 displaced(const Vec3& birthplace) const;
  // By what a place differs from `displaced` because of shorter waves, less than in linear theory:
  // strands within filaments, and knots along them.
  Vec3 strayed(const Vec3& birthplace) const;
  // By which part of the way SharpenedWeb moves what is born here: where less had collapsed, sheets
  // and the wings of filaments stay wide.
  double sharpness(const Vec3& birthplace) const;
  // The density's contrast, grown to today, averaged over balls of this radius.
  PeriodicGrid contrast(double radius) const;

 private:
  // Of waves up to `longest` per box, but not of those up to `shortest`.
  PeriodicGrid displacement(int axis, double shortest, double longest) const;

  RandomWaves waves_;
  double amplitude_;
  std::array<PeriodicGrid, 3> displacement_, straying_;
  PeriodicGrid collapsed_;
};

// Zeldovich's sheets and filaments stay thick, because matter there crosses and runs on; here it
// sticks.
class SharpenedWeb {
 public:
  // Of matter at these places, each of which moves by a part from 0 to 1 of its way.
  SharpenedWeb(std::vector<Vec3> places, const std::vector<double>& parts);

  // Where other matter moves that the web has brought here.
  Vec3 moved(Vec3 place, double part) const;

 private:
  std::vector<PeriodicGrid> densities_;  // before each step
};

}  // namespace splotchcl
