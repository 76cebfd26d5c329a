#pragma once

#include <cmath>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/vector.h"

namespace splotchcl {

// How many digits after the point write `size` with so many digits in all; below zero for
// digits before the point. `size` must not be 0.
inline double decimals_for(double size, int digits) {
  return digits - 1 - std::floor(std::log10(std::abs(size)));
}

// By whole numbers, so that the result prints with no more digits than asked for.
inline double round_to_decimals(double value, double decimals) {
  const double scale = std::pow(10, std::abs(decimals));
  const double rounded =
      decimals > 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return rounded + 0.0;  // not -0
}

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

// All that these components draw, one after the other.
std::vector<int> types_of(const std::vector<Component>& components);

// What such a picture of these particle types is about. Throws as find_target does.
Target suggest_target(const Snapshot& snapshot, const std::vector<int>& types,
                      const ImageSettings& image);

// A camera that shows what these particle types do: a periodic box from close enough
// that it fills the picture, whatever its shape, anything else whole but for its outliers.
Camera suggest_camera(const Target& target, const ImageSettings& image);

// Brings such a camera that looks in all directions so near that matter is around it. What comes
// close fades, so that clouds around the camera, of which there are thousands there, need not be
// looked through; not where a near limit or a fade is given.
void stand_amid_matter(Camera& camera);

}  // namespace splotchcl
