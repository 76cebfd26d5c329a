#pragma once

#include <vector>

#include "galaxy/light.h"

namespace splotchcl {

// Optical depths of the Milky Way's dust in red, green and blue, relative to green, where the
// channels are the bands I (0.81 um), V (0.55 um) and B (0.44 um), as in most pictures of
// galaxies: Cardelli, Clayton and Mathis (1989, ApJ 345, 245) with R_V = 3.1.
constexpr Light dust_opacity = {0.57, 1.0, 1.33};

// What a layer of dust in the middle of a thicker one of stars lets through, seen face-on. Both
// have Gaussian heights.
class Veil {
 public:
  // Standard deviations of the heights, in any unit; the stars' > 0.
  Veil(double dust_height, double star_height);

  // Of the light of all stars, for an optical depth >= 0 through the whole layer: the mean of
  // exp(-depth * the part of the dust that lies above a star).
  double transmission(double depth) const;
  // The depth that lets through this part; at most `largest`, up to 16.
  double depth(double transmission, double largest) const;

 private:
  double exact_transmission(double depth) const;

  std::vector<double> dust_above_;    // of stars in equal parts
  std::vector<double> transmission_;  // by depth, at even steps
};

}  // namespace splotchcl
