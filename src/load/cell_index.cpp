#include "load/cell_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_rules.h"
#include "scene/streamed_column.h"

namespace splotchcl {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t block_particles = SnapshotIndex::block_particles;

// One float farther than is needed: positions that the file has in double precision are rounded,
// and those that it has in single precision were, when it was written.
float below(double value, double origin) {
  const double exact = value - std::abs(value) * std::numeric_limits<float>::epsilon() - origin;
  return std::nextafter(static_cast<float>(exact), -infinity);
}

float above(double value, double origin) {
  return -below(-value, -origin);
}

void surround(const ParticleCell& cell, const Vec3& origin, ParticleBox& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], below(cell.lower[axis], origin.a[axis]));
    box.upper[axis] = std::max(box.upper[axis], above(cell.upper[axis], origin.a[axis]));
  }
}

}  // namespace

std::vector<ParticleBox> boxes_around_cells(const std::vector<ParticleCell>& cells,
                                            std::uint64_t particles, const Vec3& origin) {
  const ParticleBox nothing = {
      {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
  std::vector<ParticleBox> boxes(static_cast<std::size_t>(ceil_divide(particles, block_particles)),
                                 nothing);
  for (const ParticleCell& cell : cells) {
    const std::uint64_t last = (cell.first + cell.count - 1) / block_particles;
    for (std::uint64_t block = cell.first / block_particles; block <= last; ++block)
      surround(cell, origin, boxes[static_cast<std::size_t>(block)]);
  }
  return boxes;
}

void add_smoothing_lengths(const Column& lengths, SnapshotIndex::Type& type) {
  const auto add = [&](std::size_t begin, std::size_t end, ParticleBox& box) {
    const ColumnStretch length(lengths, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_smoothing_length(length[i])) {
        box = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}, infinity};
        return;
      }
      box.largest_smoothing_length = std::max(box.largest_smoothing_length, length[i]);
    }
  };
  const auto count = static_cast<std::size_t>(type.count);
  for_blocks(type.boxes.size(), streamed_particles / block_particles,
             [&](std::size_t first, std::size_t end) {
               for (std::size_t b = first; b < end; ++b)
                 add(b * block_particles, std::min(count, (b + 1) * block_particles),
                     type.boxes[b]);
             });
  type.has_smoothing_lengths = true;
}

SnapshotIndex index_of_cells(const Snapshot& snapshot) {
  std::vector<SnapshotIndex::Type> types;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const std::vector<ParticleCell> cells = read_swift_cells(snapshot.info(), type.type);
    if (cells.empty()) continue;
    types.push_back({type.type, type.count, false,
                     boxes_around_cells(cells, type.count, snapshot.position_origin())});
  }
  return SnapshotIndex::of(std::move(types));
}

}  // namespace splotchcl
