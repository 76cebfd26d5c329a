#pragma once

#include <vector>

#include "load/suggest_target.h"
#include "splotchcl/camera.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// What a picture of these particle types is about. Throws as find_target does.
Target suggest_target(const Snapshot& snapshot, const std::vector<int>& types, int width,
                      int height);

// A camera that shows what these particle types do: a periodic box from close enough
// that it fills the picture, anything else whole but for its outliers.
Camera suggest_camera(const Target& target);

}  // namespace splotchcl
