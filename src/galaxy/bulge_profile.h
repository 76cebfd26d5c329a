#pragma once

#include <algorithm>
#include <cmath>

#include "galaxy/light_map.h"
#include "scene/constants.h"

namespace splotchcl {

// The light of a transparent Plummer sphere along the line of sight: what the disk leaves to the
// bulge.
class BulgeProfile {
 public:
  BulgeProfile(const LightMap& map, const GalaxySettings& settings)
      : radius_(settings.bulge_radius_kpc),
        peak_((settings.bulge_stars > 0 ? settings.bulge_light : 0.0) * map.center_color()) {}

  Light column(double radius) const {
    return std::pow(1 + radius * radius / (radius_ * radius_), -2) * peak_;
  }
  // What remains of the picture's light for the disk.
  Light rest(const Light& light, double radius) const {
    const Light taken = column(radius);
    Light rest;
    for (std::size_t i = 0; i < 3; ++i)
      rest[i] = std::max(0.0, light[i] - taken[i]);
    return rest;
  }
  const Light& peak() const { return peak_; }
  // Of the face-on area that would have all of the bulge's light at the peak's brightness.
  double area() const { return pi * radius_ * radius_; }

 private:
  double radius_;
  Light peak_;
};

}  // namespace splotchcl
