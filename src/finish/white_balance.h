#pragma once

#include "splotchcl/image.h"

namespace splotchcl {

// Linear light of Rec. 709 in which that of a black body at so many kelvin, 1667 to 25000, becomes
// white (D65), by Bradford's adaptation; what falls below 0 is 0. Alpha stays.
void balance_white(Image& image, double kelvin);

}  // namespace splotchcl
