#include "load/check_particles.h"

#include <fmt/format.h>

#include <cmath>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool is_finite(const Column& column, std::size_t i) {
  return column.is_absent() || std::isfinite(column[i]);
}

bool is_good(const Particles& particles, std::size_t i) {
  const Column& position = particles.position;
  const float h = particles.smoothing_length[i];
  return std::isfinite(position[3 * i]) && std::isfinite(position[3 * i + 1]) &&
         std::isfinite(position[3 * i + 2]) && std::isfinite(h) && h > 0 &&
         is_finite(particles.weight, i) && !(particles.weight[i] < 0) &&
         is_finite(particles.color, i) && is_finite(particles.intensity, i) &&
         is_finite(particles.sort_field, i);
}

}  // namespace

void check_particles(const DrawnComponent& component, const std::string& snapshot) {
  const Particles& particles = component.particles;
  for (std::size_t i = 0; i < particles.count; ++i) {
    if (is_good(particles, i)) return;
  }
  if (particles.count == 0) return;
  throw DataError(fmt::format(
      "{}: component {}: none of its {} particles can be drawn: all have a position, smoothing "
      "length, weight, colour, intensity or sort field that is not finite, a smoothing length not "
      "above 0, or a weight below 0; splotchcl info tells which",
      snapshot, component.name, particles.count));
}

}  // namespace splotchcl
