#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cells/gaussian.h"
#include "cells/shares_on_the_sky.h"

namespace splotchcl {

// The sky as points on the six faces of a cube, evenly spaced in angle, for sums of particles that
// are wide beside their spacing: what lies between points follows from a polynomial through the
// ten nearest along each axis. Each face goes on beyond its edges, so that its own points are
// enough.
class SkyLattice {
 public:
  // Each level has twice as many points along an axis as the one before.
  explicit SkyLattice(int level);

  // The coarsest one that has a particle of this width, as an angle, to lattice_error.
  static int level_for(double width);

  static std::size_t points_of(int level);

  std::size_t points() const { return 6 * side_ * side_; }
  // A particle at the points within `reach`.
  void add_values(const GaussianOnSky& particle, double reach,
                  std::vector<CellShare>& values) const;
  // Values at the points of the next level.
  std::vector<double> refined(const std::vector<double>& values) const;

  // What values at a direction are made of.
  struct Stencil {
    static constexpr std::size_t taps = 10;
    std::size_t first = 0;   // of the points
    std::size_t stride = 0;  // from one row to the next
    std::array<double, taps> along, across;

    double of(const std::vector<double>& values) const;
  };
  Stencil stencil_at(const Vec3& direction) const;

 private:
  struct Range {
    std::size_t first = 0, end = 0;
  };
  // Of points whose angle along an axis a cap may have, from what it has along that axis and
  // towards the face.
  Range range_of(double depth, double along, double reach) const;

  double spacing_;
  std::size_t side_;              // points along an axis, with those beyond the edges
  std::vector<double> tangents_;  // of their angles
};

// Of what is between points, over the value in a particle's middle; measured, with a reserve.
constexpr double lattice_error = 1e-6;

}  // namespace splotchcl
