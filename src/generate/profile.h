#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

}  // namespace splotchcl
