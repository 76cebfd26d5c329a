#include "load/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "scene/constants.h"
#include "scene/particle_columns.h"

namespace splotchcl {
namespace {

// What the unit vectors become: the columns of scale * R.
std::array<Vec3, 3> turned_axes(const Placement& placement) {
  std::array<Vec3, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 unit = {{0, 0, 0}};
    unit.a[axis] = placement.scale;
    axes[axis] = rotated(unit, placement.axis, placement.angle_degrees);
  }
  return axes;
}

}  // namespace

Vec3 rotated(const Vec3& v, const Vec3& axis, double angle_degrees) {
  using namespace boost::qvm;
  const double angle = std::remainder(angle_degrees, 360.0) * pi / 180;
  // By the largest component first, so that no square overflows or underflows.
  const Vec3 k = normalized(
      Vec3(axis / std::max({std::abs(axis.a[0]), std::abs(axis.a[1]), std::abs(axis.a[2])})));
  return v * std::cos(angle) + cross(k, v) * std::sin(angle) +
         k * (dot(k, v) * (1 - std::cos(angle)));
}

bool only_moves(const Placement& placement) {
  return placement.angle_degrees == 0 && placement.scale == 1;
}

Vec3 placed_origin(const Placement& placement, const Vec3& center, const Vec3& origin) {
  if (!placement.moves()) return origin;
  const Vec3 target = placement.origin.value_or(center);
  return only_moves(placement) ? Vec3(target + (origin - center)) : target;
}

Column placed_positions(const Placement& placement, const Vec3& center, const Vec3& origin,
                        const Column& position, bool streams) {
  if (only_moves(placement)) return position;
  const std::array<Vec3, 3> axes = turned_axes(placement);
  const Vec3 from_center = origin - center;
  const auto place = [axes, from_center](const double* stored, double* placed) {
    double d[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[axis] = from_center.a[axis] + stored[axis];
    for (std::size_t axis = 0; axis < 3; ++axis)
      placed[axis] = d[0] * axes[0].a[axis] + d[1] * axes[1].a[axis] + d[2] * axes[2].a[axis];
  };
  return make_vectors(position, streams || is_streamed(position), place);
}

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
