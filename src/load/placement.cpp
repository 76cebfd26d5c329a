#include "load/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/constants.h"
#include "scene/streamed_column.h"

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

}  // namespace splotchcl
