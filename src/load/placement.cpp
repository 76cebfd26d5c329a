#include "load/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "load/passes.h"
#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "scene/memory_advice.h"
#include "scene/particle_columns.h"
#include "scene/statistics.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"

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

// Along the longest axis; 0 where it is not finite, which is counted as bad elsewhere.
float largest_of(const float* offset) {
  const float largest = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
  return std::isfinite(largest) ? largest : 0;
}

// Between neighbouring floats about as large.
double spacing_at(float offset) {
  return static_cast<double>(std::nextafter(offset, std::numeric_limits<float>::max()) - offset);
}

struct Rounded {
  std::uint64_t count = 0;
  double worst = 0;  // of h

  void take(const Rounded& other) {
    count += other.count;
    worst = std::max(worst, other.worst);
  }
};

// look(found, largest, h) for each particle: its offset along the longest axis, and its smoothing
// length.
template <class Found, class Look>
Found look_at_places(const Particles& particles, const ParticlePass& pass, const Look& look) {
  const auto of_run = [&](const ParticleRun& run, std::vector<Found>& results) {
    Found all;
    std::mutex of_all;
    for_blocks(run.end - run.begin, streamed_particles, [&](std::size_t first, std::size_t last) {
      const std::size_t begin = run.begin + first, end = run.begin + last;
      const ColumnStretch position(particles.position, 3 * begin, 3 * end);
      const ColumnStretch lengths(particles.smoothing_length, begin, end);
      Found some;
      for (std::size_t i = begin; i < end; ++i) {
        const float offset[3] = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
        look(some, largest_of(offset), lengths[i]);
      }
      const std::lock_guard lock(of_all);
      all.take(some);
    });
    results.push_back(all);
  };
  Found all;
  for (const Found& some : pass.collect<Found>(of_run))
    all.take(some);
  return all;
}

}  // namespace

bool are_offsets(const Particles& particles) {
  const auto& origin = particles.origin.a;
  return origin[0] != 0 || origin[1] != 0 || origin[2] != 0;
}

PlaceExtremes find_extremes(const Particles& particles, const ParticlePass& pass) {
  return look_at_places<PlaceExtremes>(
      particles, pass, [](PlaceExtremes& found, float largest, float h) {
        found.largest_offset = std::max(found.largest_offset, largest);
        if (h > 0) found.smallest_length = std::min(found.smallest_length, h);
      });
}

bool may_be_rounded(const PlaceExtremes& extremes, double size_factor) {
  const double least = size_factor * static_cast<double>(extremes.smallest_length);
  return spacing_at(extremes.largest_offset) > too_coarse * least;
}

std::optional<std::string> tell_rounded_positions(const DrawnComponent& component,
                                                  const ParticlePass& pass) {
  const Particles& particles = component.particles;
  if (!are_offsets(particles)) return std::nullopt;
  const Rounded all = look_at_places<Rounded>(
      particles, pass, [&component](Rounded& found, float largest, float length) {
        const double h = component.size_factor * static_cast<double>(length);
        if (!(h > 0)) return;
        const double part = spacing_at(largest) / h;
        if (!(part > too_coarse)) return;
        ++found.count;
        found.worst = std::max(found.worst, part);
      });
  if (all.count == 0) return std::nullopt;
  return fmt::format(
      "component {}: {} of {} particles lie so far from the others that single precision rounds "
      "their positions to more than {} of their smoothing length, at worst {:.2g}; objects far "
      "apart keep their shapes in snapshots of their own",
      component.name, all.count, particles.count, too_coarse, all.worst);
}

BoxSides periodic_box(const PeriodicSettings& settings, const SnapshotInfo& snapshot) {
  if (settings.box) return *settings.box;
  if (snapshot.box_size) return *snapshot.box_size;
  throw UsageError("key periodic.wrap: found true, but " +
                   (snapshot.files.empty() ? "the snapshot" : snapshot.files.front().string()) +
                   " does not say the size of a box, expected one; set periodic.box");
}

bool is_in_the_box(const Component& component) {
  return component.snapshot.empty() && !component.placement.moves();
}

namespace {

// nearest_image() without a call or a branch, for distances of fewer than 2^51 sides, beyond which
// doubles do not tell images apart. Added to a number of less, the rounder leaves no room for
// digits behind the point.
inline float image_of(float stored, double shift, double side) {
  constexpr double rounder = 0x1.8p52;
  const double distance = static_cast<double>(stored) + shift;
  return static_cast<float>(distance - side * ((distance / side + rounder) - rounder));
}

// In place, of values that are those from `begin` on of a column. Sixteen particles at once in a
// loop that compilers make vectors of.
void find_images(std::size_t begin, std::size_t end, const Vec3& shift, const BoxSides& box,
                 float* values) {
  constexpr std::size_t at_once = 48;
  std::size_t i = begin;
  if (end - begin >= at_once) {
    double shifts[at_once], sides[at_once];
    for (std::size_t j = 0; j < at_once; ++j) {
      shifts[j] = shift.a[(begin + j) % 3];
      sides[j] = box[(begin + j) % 3];
    }
    for (; end - i >= at_once; i += at_once) {
      for (std::size_t j = 0; j < at_once; ++j)
        values[j] = image_of(values[j], shifts[j], sides[j]);
      values += at_once;
    }
  }
  for (; i < end; ++i, ++values)
    *values = image_of(*values, shift.a[i % 3], box[i % 3]);
}

}  // namespace

Column wrapped_positions(const Vec3& shift, const BoxSides& box, const Column& position,
                         bool streams) {
  if (!position.is_array()) return position;
  const auto wrap = [position, shift, box](std::size_t begin, std::size_t end, float* out) {
    copy_values(position, begin, end, out);
    find_images(begin, end, shift, box, out);
  };
  if (streams || is_streamed(position)) return make_column(position.size(), true, wrap);
  LargeVector<float> wrapped(position.size());
  for_blocks(position.size(), 3 << 16,
             [&](std::size_t begin, std::size_t end) { wrap(begin, end, wrapped.data() + begin); });
  return owning_column(std::move(wrapped));
}

namespace {

// Positions that were wrapped in single precision may lie on both faces.
constexpr double rounding = 1e-6;

// Extents of every `stride`-th particle.
PositionExtent look_at_positions(const Snapshot& snapshot, int type, std::size_t stride) {
  const Column position = snapshot.read(type, "position");
  const Vec3 origin = snapshot.position_origin();
  const auto take = [](PositionExtent& extent, const float x, const float y, const float z) {
    const double place[] = {x, y, z};
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.lowest.a[axis] = std::min(extent.lowest.a[axis], place[axis]);
      extent.highest.a[axis] = std::max(extent.highest.a[axis], place[axis]);
    }
    ++extent.particles;
  };
  const auto look = [&](const ParticleRun& run, std::vector<PositionExtent>& found) {
    PositionExtent extent;
    if (stride > 1) {
      for (std::size_t i = first_sampled(run, stride); i < run.end; i += stride)
        take(extent, position[3 * i], position[3 * i + 1], position[3 * i + 2]);
    } else {
      std::mutex of_extent;
      for_blocks(run.end - run.begin, streamed_particles, [&](std::size_t first, std::size_t last) {
        const std::size_t begin = run.begin + first, end = run.begin + last;
        const ColumnStretch stretch(position, 3 * begin, 3 * end);
        PositionExtent some;
        for (std::size_t i = begin; i < end; ++i)
          take(some, stretch[3 * i], stretch[3 * i + 1], stretch[3 * i + 2]);
        const std::lock_guard lock(of_extent);
        extent.take(some);
      });
    }
    found.push_back(extent);
  };
  PositionExtent all;
  for (const PositionExtent& extent : pass_over(snapshot, type).collect<PositionExtent>(look))
    all.take(extent);
  if (all.is_empty()) return all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.lowest.a[axis] += origin.a[axis];
    all.highest.a[axis] += origin.a[axis];
  }
  return all;
}

PositionExtent sampled_extent(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  constexpr std::size_t most_looked_at = 200000;
  const std::size_t stride = sample_stride(static_cast<std::size_t>(type.count), most_looked_at);
  return look_at_positions(snapshot, type.type, stride);
}

}  // namespace

PlaceExtremes::PlaceExtremes() : smallest_length(std::numeric_limits<float>::infinity()) {}

void PlaceExtremes::take(const PlaceExtremes& other) {
  largest_offset = std::max(largest_offset, other.largest_offset);
  smallest_length = std::min(smallest_length, other.smallest_length);
}

PositionExtent::PositionExtent() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lowest = {{infinity, infinity, infinity}};
  highest = {{-infinity, -infinity, -infinity}};
}

void PositionExtent::take(const PositionExtent& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lowest.a[axis] = std::min(lowest.a[axis], other.lowest.a[axis]);
    highest.a[axis] = std::max(highest.a[axis], other.highest.a[axis]);
  }
  particles += other.particles;
}

PositionExtent extent_of_type(const Snapshot& snapshot, int type) {
  return snapshot.memory().get<PositionExtent>(
      fmt::format("extent of type {}", type), [&] { return look_at_positions(snapshot, type, 1); });
}

bool lies_in_one_period(const PositionExtent& extent, const BoxSides& box) {
  if (extent.is_empty()) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double far = std::max(std::abs(extent.lowest.a[axis]), std::abs(extent.highest.a[axis]));
    if (extent.span(axis) > box[axis] + rounding * std::max(box[axis], far)) return false;
  }
  return true;
}

bool fills_box(const PositionExtent& extent, const BoxSides& box, std::size_t axis) {
  constexpr std::uint64_t few = 64;
  constexpr double much = 0.5;  // of a side: 64 particles of a full box span less once in 1e17
  return extent.particles < few || extent.span(axis) >= much * box[axis];
}

Vec3 middle_of_period(const PositionExtent& extent, const BoxSides& box) {
  const auto lies_from = [&](double begin) {  // in sides
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slack = rounding * box[axis], first = begin * box[axis];
      if (extent.lowest.a[axis] < first - slack ||
          extent.highest.a[axis] > first + box[axis] + slack)
        return false;
    }
    return true;
  };
  const Vec3& sides = box.vector();
  if (lies_from(0)) return Vec3{{0.5 * sides.a[0], 0.5 * sides.a[1], 0.5 * sides.a[2]}};
  if (lies_from(-0.5)) return Vec3{{0, 0, 0}};
  Vec3 middle;
  for (std::size_t axis = 0; axis < 3; ++axis)
    middle.a[axis] = 0.5 * (extent.lowest.a[axis] + extent.highest.a[axis]);
  return middle;
}

PositionExtent find_extent(const Snapshot& snapshot, const std::vector<int>& types) {
  PositionExtent extent;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const bool is_shown = std::find(types.begin(), types.end(), type.type) != types.end();
    extent.take(is_shown ? extent_of_type(snapshot, type.type) : sampled_extent(snapshot, type));
  }
  return extent;
}

std::string tell_box_is_not_used(const BoxSides& box, const PositionExtent& extent) {
  return fmt::format(
      "the box of {} in the header is not used, since particles span {:.4g} x {:.4g} x {:.4g}: "
      "they are not periodic in it",
      box.text(), extent.span(0), extent.span(1), extent.span(2));
}

}  // namespace splotchcl
