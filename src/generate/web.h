#pragma once

#include <array>
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
