#include "load/component_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "index/snapshot_index.h"
#include "load/placement.h"
#include "parallel/available_memory.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"

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

namespace {

constexpr float no_bound = std::numeric_limits<float>::infinity();
constexpr std::size_t corners = 8;

using Index = std::shared_ptr<const SnapshotIndex>;
using KnownType = std::shared_ptr<const SnapshotIndex::Type>;
using Types = std::vector<KnownType>;

// What is known of a snapshot's blocks. Read once for all frames of a film.
struct KnownBoxes {
  Index beside;    // null: there is no index beside it, or it is stale
  Index of_cells;  // then that of its own cells, which may have no type
};

KnownBoxes known_boxes(const Snapshot& snapshot) {
  return snapshot.memory().get<KnownBoxes>("index", [&snapshot]() -> KnownBoxes {
    const SnapshotInfo& info = snapshot.info();
    if (auto index = SnapshotIndex::read(info))
      return {std::make_shared<const SnapshotIndex>(std::move(*index)), nullptr};
    if (!SnapshotIndex::is_of_use(info)) return {};
    return {nullptr, std::make_shared<const SnapshotIndex>(index_of_cells(snapshot))};
  });
}

// Cells do not tell how large particles are: their smoothing lengths are read before. That pays
// where the columns are so large that they are read in parts, and what is out of view is not.
KnownType with_smoothing_lengths(const SnapshotIndex::Type& type, const Snapshot& snapshot) {
  return snapshot.memory().get<KnownType>(
      "index with lengths " + std::to_string(type.type), [&]() -> KnownType {
        const ParticleTypeInfo* const info = snapshot.info().find_type(type.type);
        const FieldInfo* const length = find_field(*info, "smoothing_length");
        const bool pays = is_too_large_to_copy(3 * sizeof(float) * type.count);
        if (length == nullptr || length->file_name.empty() || !pays) return nullptr;
        auto known = std::make_shared<SnapshotIndex::Type>(type);
        add_smoothing_lengths(snapshot.read(type.type, length->name), *known);
        return known;
      });
}

// Blocks of the component, whose particles are those of all types.
ParticleBoxes joined(const Types& types) {
  ParticleBoxes all;
  all.block_particles = SnapshotIndex::block_particles;
  std::uint64_t first = 0;  // particle of the component
  for (const KnownType& type : types) {
    const ParticleBoxes own = {SnapshotIndex::block_particles, type->boxes};
    const std::uint64_t end = first + type->count;
    for (std::uint64_t begin = first; begin < end;) {
      const std::uint64_t block = begin / all.block_particles;
      const std::uint64_t block_end =
          std::min<std::uint64_t>(end, (block + 1) * all.block_particles);
      const ParticleBox box = own.around(begin - first, block_end - first);
      if (block < all.boxes.size()) {
        const ParticleBoxes both = {1, {all.boxes[block], box}};
        all.boxes[block] = both.around(0, 2);
      } else {
        all.boxes.push_back(box);
      }
      begin = block_end;
    }
    first = end;
  }
  return all;
}

// Null where it is not known where its particles are, or how large.
KnownType known_type(const Component& component, const Snapshot& snapshot, int type) {
  const KnownBoxes boxes = known_boxes(snapshot);
  const Index& index = boxes.beside ? boxes.beside : boxes.of_cells;
  const SnapshotIndex::Type* const known = index ? index->find(type) : nullptr;
  if (known == nullptr) return nullptr;
  if (component.size_fixed) return {index, known};
  if (canonical_field_name(component.size_field) != "smoothing_length") return nullptr;
  if (known->has_smoothing_lengths) return {index, known};
  return boxes.beside ? nullptr : with_smoothing_lengths(*known, snapshot);
}

std::optional<ParticleBoxes> boxes_as_stored(const Component& component, const Snapshot& snapshot,
                                             const std::vector<int>& types) {
  Types found;
  for (const int type : types) {
    KnownType known = known_type(component, snapshot, type);
    if (!known) return std::nullopt;
    found.push_back(std::move(known));
  }
  ParticleBoxes boxes = joined(found);
  if (component.size_fixed) {
    for (ParticleBox& box : boxes.boxes)
      box.largest_smoothing_length = static_cast<float>(*component.size_fixed);
  }
  return boxes;
}

Column corners_of(const std::vector<ParticleBox>& boxes) {
  std::vector<float> positions;
  positions.reserve(boxes.size() * corners * 3);
  for (const ParticleBox& box : boxes) {
    for (std::size_t corner = 0; corner < corners; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        positions.push_back((corner >> axis & 1) != 0 ? box.upper[axis] : box.lower[axis]);
    }
  }
  return Column::owning(std::move(positions));
}

// Around the corners of each box.
void surround(const Column& placed, std::vector<ParticleBox>& boxes) {
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float lower = no_bound, upper = -no_bound;
      bool is_finite = true;
      for (std::size_t corner = 0; corner < corners; ++corner) {
        const float x = placed[3 * (corners * b + corner) + axis];
        is_finite = is_finite && std::isfinite(x);
        lower = std::min(lower, x);
        upper = std::max(upper, x);
      }
      boxes[b].lower[axis] = is_finite ? lower : -no_bound;
      boxes[b].upper[axis] = is_finite ? upper : no_bound;
    }
  }
}

}  // namespace

std::string tell_stale_index(const Snapshot& snapshot) {
  if (known_boxes(snapshot).beside || !SnapshotIndex::is_there(snapshot.info())) return {};
  return fmt::format(
      "{} is not used: it is of other files than those beside it, damaged, or someone else's; "
      "splotchcl index makes it anew",
      SnapshotIndex::path_for(snapshot.info()).string());
}

std::shared_ptr<const ParticleBoxes> component_boxes(const Component& component,
                                                     const Snapshot& snapshot,
                                                     const std::vector<int>& types) {
  std::optional<ParticleBoxes> boxes = boxes_as_stored(component, snapshot, types);
  if (!boxes) return nullptr;
  if (!only_moves(component.placement)) {
    surround(placed_positions(component.placement, component.center, snapshot.position_origin(),
                              corners_of(boxes->boxes)),
             boxes->boxes);
  }
  return std::make_shared<const ParticleBoxes>(std::move(*boxes));
}

std::shared_ptr<const ParticleBoxes> wrapped_boxes(const ParticleBoxes& boxes, const Vec3& shift,
                                                   const BoxSides& periodic_box) {
  ParticleBoxes wrapped = boxes;
  for (ParticleBox& box : wrapped.boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double side = periodic_box[axis];
      const double lower = static_cast<double>(box.lower[axis]) + shift.a[axis];
      const double upper = static_cast<double>(box.upper[axis]) + shift.a[axis];
      const double turns = std::nearbyint(lower / side);
      const bool is_torn = !(turns == std::nearbyint(upper / side));
      if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
      const double half = side / 2;
      box.lower[axis] = static_cast<float>(is_torn ? -half : lower - turns * side);
      box.upper[axis] = static_cast<float>(is_torn ? half : upper - turns * side);
    }
  }
  return std::make_shared<const ParticleBoxes>(std::move(wrapped));
}

}  // namespace splotchcl
