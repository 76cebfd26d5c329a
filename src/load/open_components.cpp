#include "load/open_components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "formats/snapshot_format.h"
#include "load/component_reader.h"
#include "load/passes.h"
#include "load/periodic.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

void check_factor(double value, const ComponentFields& fields, const char* key) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw UsageError(
        fmt::format("{}: {} is {}, expected a finite number > 0", fields.label(), key, value));
  }
}

void check_placement(const Component& component, const ComponentFields& fields) {
  const Placement& placement = component.placement;
  double largest = 0;
  for (const double component_of_axis : placement.axis.a)
    largest = std::max(largest, std::abs(component_of_axis));
  if (std::isfinite(placement.angle_degrees) && std::isfinite(largest) && largest > 0) return;
  throw UsageError(
      fmt::format("{}: rotation is by {} degrees about the axis ({}, {}, {}), expected finite "
                  "numbers and an axis that is not 0",
                  fields.label(), placement.angle_degrees, placement.axis.a[0], placement.axis.a[1],
                  placement.axis.a[2]));
}

void check(const Component& component, const SortOrder& sort, const ComponentFields& fields) {
  check_factor(component.size_factor, fields, "size.factor");
  if (component.size_fixed) check_factor(*component.size_fixed, fields, "size.fixed");
  check_factor(component.placement.scale, fields, "scale");
  check_placement(component, fields);
  fields.check(sort);
  choose_palette(component);
}

// As the scene's own is. Names of columns are for tables: other files have names of their own.
std::shared_ptr<const Snapshot> open_companion(const std::string& path, ReadSettings read) {
  if (!read.columns.empty()) {
    std::error_code ignored;
    const SnapshotFormat* const format =
        std::filesystem::is_regular_file(path, ignored) ? find_format(path) : nullptr;
    if (format == nullptr || !format->has_columns()) read.columns.clear();
  }
  return open_snapshot_for(path, read);
}

}  // namespace

OpenComponents::OpenComponents(const Scene& scene, const Snapshot& snapshot,
                               const MissingSizes& sizes, std::vector<std::string>& notes,
                               const std::optional<BoxSides>& periodic_box) {
  for (const Component& component : scene.components) {
    const Snapshot* source = &snapshot;
    if (!component.snapshot.empty()) {
      companions_.push_back(snapshot.memory().companion(
          component.snapshot,
          [&scene](const std::string& path) { return open_companion(path, scene.read); }));
      source = companions_.back().get();
      share_passes(*source, snapshot.memory().ranks());
    }
    sources_.insert(source);
    fields_.emplace_back(component, fields_.size(), *source, sizes, notes,
                         is_in_the_box(component) ? periodic_box : std::nullopt);
  }
  auto fields = fields_.begin();
  for (const Component& component : scene.components)
    check(component, scene.sort, *fields++);
}

void OpenComponents::begin_load() {
  for (const Snapshot* const source : sources_) {
    source->memory().begin_load();
    const Snapshot& own = source->own_part();
    if (&own != source) own.memory().begin_load();
  }
}

}  // namespace splotchcl
