#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "generate/random.h"

namespace splotchcl {

// Gravity in Gadget's units: kpc, 1e10 solar masses, km/s.
constexpr double gravitational_constant = 43007.1;

// Radii of an NFW halo by enclosed mass, in units of its virial radius.
class NfwProfile {
 public:
  explicit NfwProfile(double concentration) {
    for (std::size_t i = 0; i < knots; ++i) {
      // Evenly spaced in the root of the radius: the centre is steep.
      radius_[i] = std::pow(static_cast<double>(i) / (knots - 1), 2);
      const double x = concentration * radius_[i];
      mass_[i] = std::log1p(x) - x / (1 + x);
    }
    const double total = mass_.back();
    for (double& mass : mass_)
      mass /= total;
  }

  // The radius that holds this fraction, in [0, 1], of the virial mass.
  double radius(double enclosed) const {
    const auto above = std::upper_bound(mass_.begin() + 1, mass_.end() - 1, enclosed);
    const auto i = static_cast<std::size_t>(above - mass_.begin());
    const double part = (enclosed - mass_[i - 1]) / (mass_[i] - mass_[i - 1]);
    return radius_[i - 1] + (radius_[i] - radius_[i - 1]) * part;
  }

 private:
  static constexpr std::size_t knots = 512;
  std::array<double, knots> radius_, mass_;
};

inline double smoothstep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The shape of a halo: a ball stretched along some axes and pressed along others, of the same
// volume. Symmetric.
struct HaloShape {
  std::array<Vec3, 3> rows = {Vec3{{1, 0, 0}}, Vec3{{0, 1, 0}}, Vec3{{0, 0, 1}}};
  Vec3 stretched(const Vec3& place) const {
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis)
      result.a[axis] = boost::qvm::dot(rows[static_cast<std::size_t>(axis)], place);
    return result;
  }
};

// From how matter around a halo's birthplace moves: differences[i] is the displacement between two
// points that were `distance` apart along axis i. Haloes are longest where matter fell in last,
// along the filament that they lie in.
HaloShape shape_of_halo(const std::array<Vec3, 3>& differences, double distance);

// Matter in a halo, in units of its virial radius and its circular speed: a smooth body, smaller
// haloes that have fallen into it, and what they have lost along their ways.
class HaloInterior {
 public:
  // `particles` of gas, of which none of the smaller haloes has only a few.
  HaloInterior(const HaloShape& shape, double particles, Random& random);

  struct Placed {
    Vec3 place, speed;
    double heat = 0;  // of gas: temperature relative to the virial one
  };
  // Gas of the body at a radius that holds this part of its mass, or of a smaller halo.
  Placed gas(double enclosed, Random& random) const;
  // A star of the galaxy in the middle, of one in a smaller halo, or between them.
  Placed star(Random& random) const;

 private:
  struct Smaller {
    Vec3 center, speed;
    HaloShape shape;
    double mass = 0;    // of the halo's
    double radius = 0;  // within which it has kept its matter
    double share = 0;   // of the matter in all of them, with those before it
    double star_share = 0;
  };
  Smaller make_smaller(double mass, Random& random) const;
  const Smaller& choose(double Smaller::*share, Random& random) const;

  HaloShape shape_;
  std::vector<Smaller> all_;
  double gas_in_smaller_ = 0;
};

}  // namespace splotchcl
