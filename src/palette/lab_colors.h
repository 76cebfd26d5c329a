#pragma once

#include <vector>

#include "palette/placed_colors.h"

namespace splotchcl {

// With colors between these that lie on straight lines in CIE's L*a*b* of white D65, as
// ParaView joins them where a color map says Lab: so near to each other that RGB joins them alike.
std::vector<PlacedColor> joined_in_lab(const std::vector<PlacedColor>& colors);

}  // namespace splotchcl
