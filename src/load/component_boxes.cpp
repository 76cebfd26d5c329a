#include "load/component_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "index/snapshot_index.h"
#include "load/placement.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"

namespace splotchcl {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t corners = 8;

using Types = std::vector<const SnapshotIndex::Type*>;
using Index = std::shared_ptr<const SnapshotIndex>;

// Read once for all frames of a film.
Index index_of(const Snapshot& snapshot) {
  return snapshot.memory().get<Index>("index", [&snapshot]() -> Index {
    auto index = SnapshotIndex::read(snapshot.info());
    return index ? std::make_shared<const SnapshotIndex>(std::move(*index)) : nullptr;
  });
}

// Blocks of the component, whose particles are those of all types.
ParticleBoxes joined(const Types& types) {
  ParticleBoxes all;
  all.block_particles = SnapshotIndex::block_particles;
  std::uint64_t first = 0;  // particle of the component
  for (const SnapshotIndex::Type* const type : types) {
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

std::optional<ParticleBoxes> boxes_as_stored(const Component& component, const Snapshot& snapshot,
                                             const std::vector<int>& types) {
  const Index index = index_of(snapshot);
  if (!index) return std::nullopt;
  const bool is_of_file = canonical_field_name(component.size_field) == "smoothing_length";
  Types found;
  for (const int type : types) {
    const SnapshotIndex::Type* const known = index->find(type);
    const bool tells =
        known != nullptr && (component.size_fixed || (is_of_file && known->has_smoothing_lengths));
    if (!tells) return std::nullopt;
    found.push_back(known);
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
      float lower = infinity, upper = -infinity;
      bool is_finite = true;
      for (std::size_t corner = 0; corner < corners; ++corner) {
        const float x = placed[3 * (corners * b + corner) + axis];
        is_finite = is_finite && std::isfinite(x);
        lower = std::min(lower, x);
        upper = std::max(upper, x);
      }
      boxes[b].lower[axis] = is_finite ? lower : -infinity;
      boxes[b].upper[axis] = is_finite ? upper : infinity;
    }
  }
}

}  // namespace

std::string tell_stale_index(const Snapshot& snapshot) {
  if (index_of(snapshot) || !SnapshotIndex::is_stale(snapshot.info())) return {};
  return fmt::format(
      "{} is not of the files beside it and is not used; splotchcl index makes it anew",
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
                                                   double periodic_box) {
  ParticleBoxes wrapped = boxes;
  for (ParticleBox& box : wrapped.boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lower = static_cast<double>(box.lower[axis]) + shift.a[axis];
      const double upper = static_cast<double>(box.upper[axis]) + shift.a[axis];
      const double turns = std::nearbyint(lower / periodic_box);
      const bool is_torn = !(turns == std::nearbyint(upper / periodic_box));
      if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
      const double half = periodic_box / 2;
      box.lower[axis] = static_cast<float>(is_torn ? -half : lower - turns * periodic_box);
      box.upper[axis] = static_cast<float>(is_torn ? half : upper - turns * periodic_box);
    }
  }
  return std::make_shared<const ParticleBoxes>(std::move(wrapped));
}

}  // namespace splotchcl
