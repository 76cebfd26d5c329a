#pragma once

#include <cstddef>
#include <optional>

#include "splotchcl/frame.h"

namespace splotchcl {

// A particle as the picture shows it.
struct PictureCloud {
  double x = 0, y = 0, sigma = 0;  // pixels of the whole picture
  double of_lens = 0;              // by which a lens widens it, likewise (drawn_width())
  double depth = 0;                // as that of Projected
  double column = 0;               // through its centre, times its intensity, before colour
};

// Particle i of the component. Nothing for one that is bad or outside the camera's limits.
std::optional<PictureCloud> cloud_in_picture(const DrawnComponent& component, const Frame& frame,
                                             std::size_t i);

}  // namespace splotchcl
