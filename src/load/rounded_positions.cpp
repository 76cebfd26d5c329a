#include "load/rounded_positions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

constexpr double too_coarse = 0.1;  // of h

// Between neighbouring floats about as large as the offset, along its longest axis.
double spacing_at(const float* offset) {
  const float largest = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
  if (!std::isfinite(largest)) return 0;  // counted as bad elsewhere
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::max()) - largest);
}

struct Rounded {
  std::uint64_t count = 0;
  double worst = 0;  // of h
};

Rounded find_rounded(const DrawnComponent& component, const ParticleRun& run) {
  const Particles& particles = component.particles;
  Rounded found;
  for_stretches(run, [&](std::size_t begin, std::size_t end) {
    const ColumnStretch position(particles.position, 3 * begin, 3 * end);
    const ColumnStretch lengths(particles.smoothing_length, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const float offset[3] = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
      const double h = component.size_factor * static_cast<double>(lengths[i]);
      if (!(h > 0)) continue;
      const double part = spacing_at(offset) / h;
      if (!(part > too_coarse)) continue;
      ++found.count;
      found.worst = std::max(found.worst, part);
    }
  });
  return found;
}

}  // namespace

std::optional<std::string> tell_rounded_positions(const DrawnComponent& component,
                                                  const ParticlePass& pass) {
  const Particles& particles = component.particles;
  const auto& origin = particles.origin.a;
  if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0) return std::nullopt;
  Rounded all;
  for (const Rounded& some :
       pass.collect<Rounded>([&](const ParticleRun&run, std::vector<Rounded>&found) {
         found.push_back(find_rounded(component, run));
       })) {
    all.count += some.count;
    all.worst = std::max(all.worst, some.worst);
  }
  if (all.count == 0) return std::nullopt;
  return fmt::format(
      "component {}: {} of {} particles lie so far from the others that single precision rounds "
      "their positions to more than {} of their smoothing length, at worst {:.2g}; objects far "
      "apart keep their shapes in snapshots of their own",
      component.name, all.count, particles.count, too_coarse, all.worst);
}

}  // namespace splotchcl
