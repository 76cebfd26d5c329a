#include "load/check_particles.h"

#include <fmt/format.h>

#include <vector>

#include "scene/particle_rules.h"
#include "splotchcl/error.h"

namespace splotchcl {

void check_particles(const DrawnComponent& component, const std::string& snapshot,
                     const ParticlePass& pass) {
  const Particles& particles = component.particles;
  const auto find_one = [&](const ParticleRun& run, std::vector<std::size_t>& good) {
    std::size_t i = run.begin;
    while (i < run.end && is_bad(particles, i))
      ++i;
    if (i < run.end) good.push_back(i);
  };
  if (particles.count == 0 || !pass.collect<std::size_t>(find_one).empty()) return;
  throw DataError(fmt::format(
      "{}: component {}: none of its {} particles can be drawn: all have a position, smoothing "
      "length, weight, colour, intensity or sort field that is not finite, a smoothing length not "
      "above 0, or a weight or own colour below 0; splotchcl info tells which",
      snapshot, component.name, particles.count));
}

}  // namespace splotchcl
