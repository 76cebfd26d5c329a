#pragma once

#include <vector>

#include "palette/placed_colors.h"

namespace splotchcl {

// With colors between these as ParaView has them where a color map says Diverging: in polar
// coordinates of L*a*b*, and over white between two colors that are far apart (K. Moreland,
// "Diverging Color Maps for Scientific Visualization", 2009).
std::vector<PlacedColor> joined_over_white(const std::vector<PlacedColor>& colors);

}  // namespace splotchcl
