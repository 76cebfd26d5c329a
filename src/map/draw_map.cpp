#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/words.h"
#include "load/components.h"
#include "load/missing_sizes.h"
#include "map/geometry.h"
#include "map/map_units.h"
#include "map/placed_particles.h"
#include "map/quantity.h"
#include "map/sky.h"
#include "map/sums.h"
#include "map/weighted_values.h"
#include "snapshot/field_names.h"
#include "snapshot/field_statistics.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

namespace splotchcl {
namespace {

const Component& choose_component(const Scene& scene) {
  if (scene.components.empty()) {
    throw UsageError("the scene has no component, expected at least one; add a [[component]]");
  }
  if (scene.map.component.empty()) return scene.components.front();
  std::vector<std::string> names;
  for (const Component& component : scene.components) {
    if (component.name == scene.map.component) return component;
    names.push_back(component.name);
  }
  throw UsageError("key map.component: found \"" + scene.map.component +
                   "\", expected the name of a component" +
                   did_you_mean(nearest_name(scene.map.component, names)));
}

// A map's numbers would be of a part of what is there.
void refuse_rim(const Component& component) {
  if (!component.select.sphere_rim) return;
  throw UsageError(
      "key component.select.sphere.rim: found it in a map, which counts whole particles, expected "
      "a sphere without a rim");
}

// The scene with the map's component alone.
Scene scene_of_map(const Scene& scene) {
  Scene one = scene;
  one.components = {choose_component(scene)};
  refuse_rim(one.components.front());
  // What colors its particles in pictures need not be there.
  Component& component = one.components.front();
  component.color = {};
  component.intensity = {};
  component.color_vector.clear();
  // It is no picture: what is drawn over pictures is not looked at here.
  one.finish = {};
  one.sort = {};
  return one;
}

bool has_densities(const Component& component, const SnapshotInfo& info) {
  return std::all_of(component.types.begin(), component.types.end(), [&info](int type) {
    const ParticleTypeInfo* const particles = info.find_type(type);
    if (particles == nullptr) return true;
    const FieldInfo* const density = find_field(*particles, "density");
    return density != nullptr && !density->file_name.empty();
  });
}

MapMatter read_matter(const Component& component, const MapSettings& settings,
                      const ComponentFields& fields) {
  const double size_factor = settings.size_factor;
  MapMatter matter;
  matter.count = fields.count();
  matter.before_selecting = fields.count_before_selecting();
  matter.origin = fields.origin();
  matter.position = fields.positions();
  matter.smoothing_length = fields.smoothing_lengths();
  if (fields.masses_are_known()) matter.mass = fields.with_factors(fields.masses());
  if (settings.center_at == MapCenter::densest &&
      has_densities(component, fields.snapshot_info())) {
    matter.density = fields.scalars("density", "map.center_at");
  }
  // What makes a picture sharper or softer has no place among numbers.
  matter.size_factor = component.size_fixed ? size_factor : size_factor * component.placement.scale;
  return matter;
}

bool is_infinite(const Column& column, std::size_t value) {
  return !column.is_absent() && std::isinf(column[value]);
}

// Of a map's particles the first: all of them are bad.
std::string advice_on_first(const MapMatter& matter, const MapQuantity& quantity) {
  const bool is_beyond = is_infinite(matter.position, 0) || is_infinite(matter.position, 1) ||
                         is_infinite(matter.position, 2) ||
                         is_infinite(matter.smoothing_length, 0) ||
                         is_infinite(quantity.weight, 0) || is_infinite(quantity.value, 0);
  return is_beyond ? "; " + advice_on_infinite_values() : "";
}

// A map of nothing but bad particles would look like one of empty space.
void refuse_all_bad(const MapMatter& matter, const MapQuantity& quantity,
                    const ComponentFields& fields) {
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (matter.is_good(i) && quantity.is_good(i)) return;
  }
  if (matter.count == 0) return;
  throw DataError(fmt::format(
      "{}: {}: none of its {} particles can be mapped: all have a position, smoothing length, "
      "weight or value that is not finite, a smoothing length not above 0, or a weight below 0; "
      "splotchcl info tells which{}",
      fields.snapshot_info().files.front().string(), fields.label(), matter.count,
      advice_on_first(matter, quantity)));
}

// OpenComponents has refused a component without particles.
std::vector<int> present_types(const Component& component, const SnapshotInfo& info) {
  std::vector<int> types;
  std::copy_if(component.types.begin(), component.types.end(), std::back_inserter(types),
               [&info](int type) { return info.find_type(type) != nullptr; });
  return types;
}

const char* name_of(MapView view) {
  switch (view) {
    case MapView::xy:
      return "xy";
    case MapView::xz:
      return "xz";
    case MapView::yz:
      return "yz";
    case MapView::camera:
      break;
  }
  return "camera";
}

// Files hold single precision: what does not fit is refused, not cut.
std::vector<float> in_unit(const std::vector<double>& values, const MapUnits& units) {
  std::vector<float> converted(values.size());
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i] * units.factor;
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    converted[i] = static_cast<float>(value);
  }
  using Limits = std::numeric_limits<float>;
  if (largest == 0 || (largest <= double{Limits::max()} && largest >= double{Limits::min()})) {
    return converted;
  }
  throw UsageError(fmt::format(
      "key map.unit: found \"{}\", in which the map's largest value is {:.3g}, expected a unit in "
      "which it lies between {:.3g} and {:.3g}",
      units.name, largest, Limits::min(), Limits::max()));
}

void describe_place(const MapGeometry& geometry, const MapSettings& settings,
                    const SnapshotInfo& snapshot, const MapUnits& units, Map& map) {
  using boost::qvm::dot;
  map.view = name_of(settings.view);
  map.right_name = settings.view == MapView::camera ? "right" : map.view.substr(0, 1);
  map.up_name = settings.view == MapView::camera ? "up" : map.view.substr(1);
  map.length_unit = units.length_name;
  map.length_factor = units.length_factor;
  map.pixel = geometry.pixel * units.length_factor;
  map.center = geometry.center * units.length_factor;
  map.center_right = dot(map.center, geometry.right);
  map.center_up = dot(map.center, geometry.up);
  map.sky = decide_sky(settings, snapshot, units, map.pixel);
}

// Of a range that is set.
void note_outside(const VelocityChannels& channels, std::size_t count,
                  std::vector<std::string>& notes) {
  const double end = channels.first_edge + channels.count * channels.width;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto velocity = static_cast<double>(channels.velocity[i]);
    outside += velocity < channels.first_edge || velocity > end ? 1 : 0;
  }
  if (outside == 0) return;
  notes.push_back(fmt::format(
      "key map.velocity_range: {} of {} particles have a velocity outside of it", outside, count));
}

VelocityAxis axis_of(const VelocityChannels& channels, const std::pair<std::string, double>& told) {
  const auto& [unit, factor] = told;
  return {channels.count, factor * (channels.first_edge + 0.5 * channels.width),
          factor * channels.width, unit};
}

}  // namespace

double read_map_length(const std::string& text, const Scene& scene, const Snapshot& snapshot,
                       const std::string& what) {
  const std::vector<int> types = present_types(choose_component(scene), snapshot.info());
  if (types.empty()) throw UsageError(what + ": the map's component has no particles");
  return length_in_snapshot(text, scene.map, snapshot.info(), types.front(), what);
}

Map draw_map(const Scene& scene, const Snapshot& snapshot, const DrawFrame& draw,
             std::vector<std::string>& notes, const LoadProgress& progress) {
  const MapSettings& settings = scene.map;
  check_quantity(settings);
  const Scene one = scene_of_map(scene);
  const Component& component = one.components.front();
  const PeriodicRegion region = find_region(one, component, snapshot, notes);
  OpenComponents open(one, snapshot, missing_sizes(one, progress), notes, region.box);
  ComponentFields& fields = open.fields().front();
  fields.select();
  const MapMatter matter = read_matter(component, settings, fields);
  const MapGeometry geometry = decide_geometry(one, matter, region);
  const std::vector<int> types = present_types(component, fields.snapshot_info());
  const MapQuantity quantity =
      read_quantity(settings, geometry, fields, types.front(), matter.count);
  refuse_all_bad(matter, quantity, fields);
  const MapUnits units = decide_units(settings, fields.snapshot_info(),
                                      present_types(component, fields.snapshot_info()),
                                      quantity.kind, geometry.width * geometry.pixel);

  const PlacedParticles placed =
      place_particles(matter, geometry, one.kernel.width, settings.slice);
  WeightedValues weighted(placed, quantity, settings.floor, geometry, one.kernel.width,
                          fields.particles_per_drawn());
  const SumPicture picture = {geometry.width, geometry.height, one.kernel.width, one.tolerance};

  Map map;
  map.width = geometry.width;
  map.height = geometry.height;
  map.quantity = quantity.description;
  map.unit = units.name;
  describe_place(geometry, settings, fields.snapshot_info(), units, map);
  map.tolerance = one.tolerance;
  map.floor = weighted.floor();
  map.particles = matter.count;
  map.images = placed.count();
  map.bad_particles = placed.bad + weighted.bad();
  const VelocityChannels& channels = quantity.channels;
  const std::vector<double> values = channels.count > 0
                                         ? weighted.draw_channels(channels, picture, draw)
                                         : weighted.draw(picture, draw);
  if (channels.count > 0)
    map.velocity =
        axis_of(channels, told_velocity(settings, fields.snapshot_info(), types.front()));
  map.values = in_unit(values, units);
  map.value_floor = weighted.value_floor() * units.factor;
  if (settings.noise) {
    map.effective_particles =
        draw_effective_particles(placed, weighted, picture, settings.floor, draw);
  }
  if (component.size_factor != 1 && settings.size_factor == 1) {
    notes.push_back(
        fmt::format("component \"{}\": size.factor {} is for pictures; the map has smoothing "
                    "lengths as they are "
                    "(map.size_factor)",
                    component.name, component.size_factor));
  }
  if (map.bad_particles > 0) {
    notes.push_back(std::to_string(map.bad_particles) +
                    " particles are left out of the map: their position, smoothing length, weight "
                    "or value is not finite, the length not above 0, or the weight below 0");
  }
  if (settings.velocity_range && channels.count > 0) note_outside(channels, matter.count, notes);
  if (matter.count > 0 && placed.count() == 0)
    notes.push_back("no particle reaches the map, which is empty");
  return map;
}

}  // namespace splotchcl
