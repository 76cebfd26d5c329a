#pragma once

#include <vector>

#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// What a picture of some particles is to show, and from where it is seen.
struct Target {
  // A box that is filled; an object; one that is much longer than wide, as a shock tube.
  enum class Shape { box, object, bar };
  Shape shape = Shape::object;
  Vec3 center = {{0, 0, 0}};
  double size = 1;  // side of a box; half the width of a picture that shows all else
  Vec3 towards_camera = {{0, -1, 0}};  // of length 1
  Vec3 sky = {{0, 0, 1}};
  // Matter is spread over a box almost evenly, as in initial conditions.
  bool is_smooth = false;
};

// What the particles of these types are, from a sample of their positions; `aspect` is the height
// of the picture over its width. Throws DataError when none of the types has a particle at a finite
// position.
Target find_target(const Snapshot& snapshot, const std::vector<int>& types, double aspect);

}  // namespace splotchcl
