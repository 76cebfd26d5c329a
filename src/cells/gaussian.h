#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "splotchcl/vector.h"

// The kernel of maps, exp(-|x|^2 / sigma^2) over its integral, in double precision.
namespace splotchcl {

// Beyond this many sigma is 2e-16 of a particle.
constexpr double kernel_reach = 6;

// Along one axis, from its middle: how much lies between `low` and `high`. With all its digits,
// however little.
double gaussian_between(double low, double high, double sigma);

// Around a particle at this distance from a point: how much lies between the spheres of radius
// `low` and `high` around the point.
double gaussian_in_shell(double distance, double low, double high, double sigma);

// A particle as it is seen on the sky from the origin: what lies in a direction, per solid angle.
// The integral over all directions is 1, also where the origin lies within the particle.
class GaussianOnSky {
 public:
  GaussianOnSky(const Vec3& place, double sigma);

  double operator()(const Vec3& direction) const;
  // Over its own integral along the line of sight through its middle: what is left at a direction
  // is about exp(-square).
  double square(const Vec3& direction) const;
  // The unit vector to its middle; of one at the origin any.
  const Vec3& middle() const { return middle_; }
  // Sigma as an angle; the origin sees no structure above about one radian.
  double width() const { return width_; }
  // The angle from its middle beyond which nothing is left; pi where it is all around.
  double reach() const { return reach_of(kernel_reach * kernel_reach); }
  // Beyond which square() is larger, and nothing is left for one beyond kernel_reach.
  double reach_of(double square) const;

 private:
  Vec3 middle_;
  double distance_;  // in sigma
  double width_;
};

// Cells of equal width side by side.
struct CellsAlongAxis {
  double first = 0, width = 1;  // of the first one its lower edge
  int count = 0;
  std::optional<double> period;  // of a periodic box, whose images count, too
};

// Cells in a row, and how much of a particle lies in each.
struct SharesAlongAxis {
  int first = 0;
  std::vector<double> parts;

  int end() const { return first + static_cast<int>(parts.size()); }
};

// One row for each image that reaches the cells.
void find_shares_along_axis(const CellsAlongAxis& cells, double place, double sigma,
                            std::vector<SharesAlongAxis>& rows);

}  // namespace splotchcl
