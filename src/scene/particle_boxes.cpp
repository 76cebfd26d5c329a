#include <algorithm>
#include <limits>

#include "splotchcl/particles.h"

namespace splotchcl {

ParticleBox ParticleBoxes::around(std::size_t first, std::size_t end) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  ParticleBox all = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
  for (std::size_t b = first / block_particles; b * block_particles < end; ++b) {
    const ParticleBox& box = boxes.at(b);
    for (int axis = 0; axis < 3; ++axis) {
      all.lower[axis] = std::min(all.lower[axis], box.lower[axis]);
      all.upper[axis] = std::max(all.upper[axis], box.upper[axis]);
    }
    all.largest_smoothing_length =
        std::max(all.largest_smoothing_length, box.largest_smoothing_length);
  }
  return all;
}

}  // namespace splotchcl
