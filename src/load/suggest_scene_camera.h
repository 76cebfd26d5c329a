#pragma once

#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A camera that shows what these particle types do: a periodic box from close enough
// that it fills the picture, anything else whole but for its outliers. Throws DataError
// when none of the types has a particle at a finite position.
Camera suggest_camera(const Snapshot& snapshot, const std::vector<int>& types, int width,
                      int height);

}  // namespace splotchcl
