#pragma once

#include "splotchcl/image.h"
#include "splotchcl/stereo.h"

namespace splotchcl {

// Both eyes' pictures, of the same size, in one for glasses of red (left) and cyan (right), as
// splotchcl/stereo.h has it. The matrices are about what a display emits: light is taken as the
// display shows it, the display value v = L^(1/gamma) to the power 2.2 and from 0 to 1, and what
// comes out of them is held to 0 and 1, too. Alpha is the mean of both.
Image anaglyph(const Image& left, const Image& right, StereoLayout layout, double gamma);

}  // namespace splotchcl
