#pragma once

#include <cstdint>
#include <vector>

#include "generate/halo_profile.h"
#include "generate/web.h"

namespace splotchcl {

constexpr double universe_box = 50000;  // kpc/h
constexpr double stars_per_gas = 0.1;   // in mass

// Internal energy of gas at the mean density, and how it grows with density: (km/s)^2.
double web_energy(double contrast);
double mean_gas_density();
// Within the box in single precision, too.
Vec3 into_box(Vec3 place);

// A periodic box of cosmic web and haloes, today, from which particles are drawn.
class Universe {
 public:
  struct Gas {
    Vec3 place, speed;
    double heat = 0;  // the part of its internal energy from falling into a halo, (km/s)^2
  };
  struct Star {
    Vec3 place, speed;
    float age = 0;
  };

  // For so many particles of gas. Where the web has denser matter is found with `tracers` of them,
  // whose birthplaces are the first of an even sequence.
  Universe(std::uint64_t gas, std::uint64_t tracers, Random& random);

  const std::vector<Vec3>& tracers() const { return tracers_; }  // their birthplaces

  // Where the web brings what is born here. Lengths in units of the box.
  Vec3 moved(const Vec3& birthplace) const;
  // What is born here and was brought there; in a halo it settles.
  Gas gas(const Vec3& birthplace, const Vec3& moved_to, Random& random) const;
  Star star(Random& random) const;

 private:
  Web web_;
  std::vector<Halo> haloes_;
  std::vector<Vec3> tracers_;
  SharpenedWeb sharpened_;
  std::vector<HaloInterior> interiors_;
  HaloMap map_;
  std::vector<double> star_shares_;  // of haloes, with those before
};

}  // namespace splotchcl
