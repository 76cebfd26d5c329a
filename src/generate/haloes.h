#pragma once

#include <vector>

#include "generate/waves.h"

namespace splotchcl {

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

}  // namespace splotchcl
