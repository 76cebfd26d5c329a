#pragma once

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The scene with map.width, depth, center and shell as numbers, where they are written with units;
// an angle as what is seen under it from map.distance, or in degrees for a map of the sky. Throws
// UsageError.
Scene with_lengths_as_numbers(const Scene& scene, const Snapshot& snapshot);

}  // namespace splotchcl
