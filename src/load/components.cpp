#include "load/components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/snapshot_format.h"
#include "load/passes.h"
#include "load/placement.h"
#include "snapshot/load_memory.h"
#include "splotchcl/error.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

// Of the brightest color of a palette: less is dark.
constexpr float dark_part = 0.25F;

float brightest_channel(const Rgb& color) {
  return *std::max_element(color.begin(), color.end());
}

}  // namespace

Palette choose_palette(const Component& component) {
  Palette palette;
  if (component.color_vector.empty()) {
    palette = load_palette(component.palette);
  } else {
    palette.name = "white";
    palette.emission = {Rgb{1, 1, 1}};
  }
  const std::string& other = component.absorption_palette;
  const bool is_the_same = component.color_vector.empty() && other == component.palette;
  if (other.empty() || is_the_same) return palette;
  const Palette absorbing = load_palette(other);
  palette.absorption = absorbing.has_own_absorption() ? absorbing.absorption : absorbing.emission;
  return palette;
}

std::optional<std::string> tell_dark_color(const Component& component, const Palette& palette) {
  if (!component.color.field.empty() || !component.color_vector.empty()) return std::nullopt;
  float brightest = 0;
  for (const Rgb& color : palette.emission)
    brightest = std::max(brightest, brightest_channel(color));
  if (brightest_channel(palette.emission.front()) >= dark_part * brightest) return std::nullopt;
  return fmt::format(
      "without color.field all of its particles take the first color of the palette {}, which is "
      "dark; name a field, or a palette that begins with a brighter color",
      palette.name);
}

namespace {

// Lengths of the snapshot are scaled with it; a fixed size is a length of the scene.
double drawn_size_factor(const Component& component) {
  return component.size_fixed ? component.size_factor
                              : component.size_factor * component.placement.scale;
}

}  // namespace

WeightModel ComponentReader::weight() const {
  return component_.weight.value_or(fields_.masses_are_known() ? WeightModel::mass
                                                               : WeightModel::constant);
}

void ComponentReader::select() {
  if (is_selected_) return;
  fields_.select();
  is_selected_ = true;
}

std::size_t ComponentReader::count() {
  select();
  return fields_.count();
}

const Column& ComponentReader::read_once(std::optional<Column>& column, const std::string& field,
                                         const char* key) {
  if (!column) {
    select();
    column = field.empty() ? Column() : fields_.scalars(field, key);
  }
  return *column;
}

const Column& ComponentReader::color() {
  return read_once(color_, component_.color.field, "color.field");
}

const Column& ComponentReader::intensity() {
  return read_once(intensity_, component_.intensity.field, "intensity.field");
}

const std::shared_ptr<const TreeOfComponent>& ComponentReader::tree(WeightModel weight) {
  if (!tree_) {
    select();
    tree_ = fields_.tree(weight);
  }
  return *tree_;
}

Column ComponentReader::weights(WeightModel weight) const {
  switch (weight) {
    case WeightModel::mass:
      return fields_.masses();
    case WeightModel::density:
      return fields_.scalars("density", "weight = \"density\"");
    case WeightModel::constant:
      break;
  }
  return {};
}

DrawnComponent ComponentReader::dark(WeightModel weight) const {
  DrawnComponent drawn;
  drawn.name = fields_.name();
  drawn.size_factor = drawn_size_factor(component_);
  drawn.brightness = component_.brightness;
  drawn.absorption = component_.absorption;
  drawn.palette = choose_palette(component_);
  drawn.weight = weight;
  drawn.particles_per_drawn = fields_.particles_per_drawn();
  return drawn;
}

DrawnComponent ComponentReader::drawn(WeightModel weight) {
  select();
  DrawnComponent drawn = dark(weight);
  Particles& particles = drawn.particles;
  particles.count = fields_.count();
  particles.origin = fields_.origin();
  particles.position = fields_.positions();
  particles.smoothing_length = fields_.smoothing_lengths();
  particles.weight = fields_.with_factors(weights(weight));
  particles.boxes = fields_.boxes();
  particles.tree = tree(weight);
  particles.color = color();
  if (!component_.color_vector.empty()) {
    particles.color_vector = fields_.vectors(component_.color_vector, "color.vector");
  }
  particles.intensity = intensity();
  if (sort_.by == SortOrder::By::field) {
    particles.sort_field = fields_.scalars(sort_.field, "sort.by");
  }
  return drawn;
}

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

// As the scene's own is. Names of columns and lines to skip are for tables: other files have names
// of their own.
std::shared_ptr<const Snapshot> open_companion(const std::string& path, ReadSettings read) {
  if (!read.columns.empty() || read.skip_lines > 0) {
    std::error_code ignored;
    const SnapshotFormat* const format =
        std::filesystem::is_regular_file(path, ignored) ? find_format(path) : nullptr;
    if (format == nullptr || !format->has_columns(read.columns)) read.columns.clear();
    if (format != &text_table_format()) read.skip_lines = 0;
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

void require_chosen_components(const Scene& scene) {
  if (!scene.look || !scene.components.empty()) return;
  throw UsageError(
      "key look: found it in a scene whose components are still to be chosen, expected them in the "
      "scene; splotchcl render FILE --explain writes them out");
}

}  // namespace splotchcl
