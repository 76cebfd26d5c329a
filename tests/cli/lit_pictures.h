#pragma once

#include "splotchcl/image.h"
#include "testing.h"

namespace splotchcl::test {

// A quarter of a film's frame is brighter than 2 % of white, and hardly any pixel is white. Values
// are those of an 8-bit file of gamma 2.2.
inline void expect_lit(const Image& shown, int frame) {
  const float seen = std::pow(0.02F, 1 / 2.2F);
  std::size_t lit = 0, white = 0;
  for (std::size_t i = 0; i < shown.pixels.size(); i += 4) {
    const auto [darkest, brightest] =
        std::minmax({shown.pixels[i], shown.pixels[i + 1], shown.pixels[i + 2]});
    lit += brightest > seen;
    white += darkest >= 1;
  }
  const double pixels = static_cast<double>(shown.pixels.size()) / 4;
  EXPECT_GE(static_cast<double>(lit) / pixels, 0.25) << "frame " << frame;
  EXPECT_LE(static_cast<double>(white) / pixels, 0.01) << "frame " << frame;
}

}  // namespace splotchcl::test
