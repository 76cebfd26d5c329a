#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// What merging particles into one Gaussian errs by follows from these (docs/dev/accuracy.md, Merged
// particles). Means over members, weighted by their flux, about their centroid; h is a smoothing
// length. Lengths are in sides of the tree's cube.
struct NodeMoments {
  double flux = 0;
  Vec3 centroid = {{0, 0, 0}};
  std::array<double, 6> second = {};     // <d d'>: xx xy xz yy yz zz
  std::array<double, 10> third = {};     // <d d d>: xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz
  double fourth = 0;                     // <|d|^4>
  double h2 = 0, h4 = 0;                 // <h^2>, <h^4>
  double inverse_h2 = 0;                 // <1 / h^2>
  std::array<double, 3> h2_offset = {};  // <h^2 d>
  double h2_spread = 0;                  // <h^2 |d|^2>
  double widest = 0;                     // h
  double reach = 0;                      // of the farthest member's center from the centroid

  static NodeMoments of_particle(double flux, const Vec3& place, double h);
  // Exact up to roundings. At least one part has flux.
  static NodeMoments merged(const std::vector<const NodeMoments*>& parts);

  double variance() const { return (second[0] + second[3] + second[5]) / 3; }  // per axis
  // Of widths, that of most of the peaks over that of the mean square: 1 where all are as wide.
  double narrowness() const { return 1 / std::sqrt(inverse_h2 * h2); }
};

// How far members are from one round Gaussian, with standard deviations of `deviation_per_h` h:
// Frobenius norms of tensors.
struct NodeShape {
  double uneven = 0;  // the second moment's from a round one's
  double third = 0;   // the third central moment
  double fourth = 0;  // the fourth cumulant, traced
};
NodeShape shape_of(const NodeMoments& moments, double deviation_per_h);

}  // namespace splotchcl
