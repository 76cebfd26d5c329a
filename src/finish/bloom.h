#pragma once

#include "splotchcl/image.h"

namespace splotchcl {

// Scatters a part, 0 to 1, of a picture's light around where it falls, as a lens does:
//   L' = (1 - part) L + part (B1 * L + B2 * L + B3 * L) / 3
// with bells B of standard deviations of 1/360, 1/90 and 2/45 of the picture's shorter side. Light
// that would leave the picture is mirrored back, so that all of it stays; alpha stays as it is.
void add_bloom(Image& image, double part);

// What add_bloom does with one bell of so many pixels: along each axis four boxes whose outermost
// samples count in part, which have its variance (P. Gwosdek et al. 2011, LNCS 6667, 447).
Image blurred(const Image& image, double deviation);

}  // namespace splotchcl
