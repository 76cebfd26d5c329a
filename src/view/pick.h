#pragma once

#include <optional>

#include "splotchcl/frame.h"

namespace splotchcl::view {

// The place in space of what one sees at a place of the picture, in its pixels: the particle in the
// middle, by depth, of the matter whose clouds reach there. Nothing where no cloud does.
std::optional<Vec3> pick_particle(const Frame& frame, double x, double y);

}  // namespace splotchcl::view
