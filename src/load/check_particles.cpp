#include "load/check_particles.h"

#include <fmt/format.h>

#include "scene/particle_rules.h"
#include "splotchcl/error.h"

namespace splotchcl {

void check_particles(const DrawnComponent& component, const std::string& snapshot) {
  const Particles& particles = component.particles;
  for (std::size_t i = 0; i < particles.count; ++i) {
    if (!is_bad(particles, i)) return;
  }
  if (particles.count == 0) return;
  throw DataError(fmt::format(
      "{}: component {}: none of its {} particles can be drawn: all have a position, smoothing "
      "length, weight, colour, intensity or sort field that is not finite, a smoothing length not "
      "above 0, or a weight or own colour below 0; splotchcl info tells which",
      snapshot, component.name, particles.count));
}

}  // namespace splotchcl
