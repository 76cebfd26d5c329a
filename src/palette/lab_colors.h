#pragma once

#include <array>
#include <functional>
#include <vector>

#include "palette/placed_colors.h"

namespace splotchcl {

using Three = std::array<double, 3>;

// CIE's L*a*b* of white D65, of colors as a display shows them.
Three lab_of(const Rgb& color);
Rgb color_of_lab(const Three& lab);

// The color at a part of the way from one to the next.
using Between = std::function<Rgb(const Rgb& before, const Rgb& after, double part)>;

// With colors between these, so near to each other that RGB joins them alike.
std::vector<PlacedColor> joined(const std::vector<PlacedColor>& colors, const Between& between);

// On straight lines in L*a*b*, as ParaView joins them where a color map says Lab.
std::vector<PlacedColor> joined_in_lab(const std::vector<PlacedColor>& colors);

}  // namespace splotchcl
