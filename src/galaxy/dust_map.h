#pragma once

#include <cstddef>
#include <vector>

#include "galaxy/dust_law.h"
#include "splotchcl/galaxy.h"

namespace splotchcl {

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
  // What the picture would show without dust.
  void unveil(Image& picture) const;

 private:
  int width_ = 0;
  Light opacity_ = dust_opacity;
  Veil veil_;
  std::vector<double> depths_;
};

}  // namespace splotchcl
