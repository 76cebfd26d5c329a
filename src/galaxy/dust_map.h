#pragma once

#include <cstddef>
#include <vector>

#include "galaxy/light.h"
#include "splotchcl/galaxy.h"

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

// How much dust a galaxy's picture shows, seen face-on. Where it is darker than its surroundings
// there is dust in front of them; a little lies everywhere between, more where there is more light.
class DustMap {
 public:
  // A galaxy without a sky; `width` is that of the widest lanes in pixels, and light below
  // `faintest` tells nothing.
  DustMap(const Image& picture, const GalaxySettings& settings, double width, double faintest);

  // In green, at a pixel.
  double depth(int x, int y) const {
    return depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  // Of red, green and blue, relative to green; the same in a picture without colours.
  const Light& opacity() const { return opacity_; }
  // Where the galaxy itself fades; a factor for each pixel, rows from the top.
  void multiply(const std::vector<double>& factors);
  // What the picture would show without dust.
  void unveil(Image& picture) const;

 private:
  int width_ = 0;
  Light opacity_ = dust_opacity;
  Veil veil_;
  std::vector<double> depths_;
};

}  // namespace splotchcl
