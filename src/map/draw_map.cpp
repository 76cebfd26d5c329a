#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "load/components.h"
#include "load/missing_sizes.h"
#include "map/cell_map.h"
#include "map/geometry.h"
#include "map/map_units.h"
#include "map/place.h"
#include "map/quantity.h"
#include "map/shape.h"
#include "map/sums.h"
#include "scene/statistics.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/map.h"

namespace splotchcl {
namespace {

// A map's numbers would be of a part of what is there.
void refuse_rim(const Component& component) {
  if (!component.select.sphere_rim) return;
  throw UsageError(
      "key component.select.sphere.rim: found it in a map, which counts whole particles, expected "
      "a sphere without a rim");
}

Scene scene_of_map(const Scene& scene) {
  const Component& component = component_of_map(scene);
  refuse_rim(component);
  return scene_of_numbers(scene, component);
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
    case MapView::sky:
      return "sky";
    case MapView::camera:
      break;
  }
  return "camera";
}

// Files hold single precision: what does not fit is refused, not cut.
// Of what lies above the floor too much may lose digits, which a note tells.
std::vector<float> in_unit(const std::vector<double>& values, const MapUnits& units, double floor,
                           std::vector<std::string>& notes) {
  using Limits = std::numeric_limits<float>;
  std::vector<float> converted(values.size());
  double largest = 0;
  std::size_t small = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i] * units.factor;
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    const bool counts = value != 0 && std::abs(value) >= floor;
    if (counts && std::abs(value) < double{Limits::min()}) ++small;
    converted[i] = static_cast<float>(value);
  }
  if (small > 0) {
    notes.push_back(fmt::format(
        "key map.unit: {} values are below {:.3g} {}, where single precision has fewer digits; "
        "choose another unit",
        small, Limits::min(), units.name));
  }
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
  const std::vector<int> types = present_types(component_of_map(scene), snapshot.info());
  if (types.empty()) throw UsageError(what + ": the map's component has no particles");
  return length_in_snapshot(text, scene.map, snapshot.info(), types.front(), what);
}

namespace {

// What is read before anything is drawn.
struct MapPlan {
  const Component& component;
  const SnapshotInfo& snapshot;
  std::vector<int> types;  // those that are there
  MapMatter matter;
  MapGeometry geometry;
  MapQuantity quantity;
  MapUnits units;
};

// Of what has no pixels in a plane only the center counts, of voxels also how large they are.
Scene scene_of_geometry(const Scene& scene, MapShape shape) {
  if (!is_made_of_cells(shape)) return scene;
  Scene plain = scene;
  plain.map.view = MapView::xy;
  if (shape == MapShape::voxels) {
    plain.image.width = scene.map.voxels[0];
    plain.image.height = scene.map.voxels[1];
  } else {
    plain.map.width = 1;
  }
  if (shape == MapShape::histogram) plain.map.center = Vec3{{0, 0, 0}};
  return plain;
}

MapGeometry geometry_of(const Scene& scene, MapShape shape, const MapMatter& matter,
                        const PeriodicRegion& region) {
  MapGeometry geometry = decide_geometry(scene_of_geometry(scene, shape), matter, region);
  geometry.is_around_center = is_around_the_center(shape);
  return geometry;
}

double farthest_from(const Vec3& center, const MapMatter& matter) {
  double farthest = 0;
  for (std::size_t i = 0; i < matter.count; ++i) {
    if (matter.is_good(i))
      farthest = std::max(farthest, boost::qvm::mag(Vec3(matter.position_of(i) - center)));
  }
  return farthest;
}

// What coordinates are told in follows from it, in the snapshot's lengths.
double extent_of(const MapPlan& plan, const MapSettings& settings) {
  const MapGeometry& geometry = plan.geometry;
  if (settings.shell) return (*settings.shell)[1];
  if (settings.voxels[0] > 0) return geometry.pixel * settings.voxels[0];
  if (!geometry.is_around_center) return geometry.width * geometry.pixel;
  return geometry.box ? (*geometry.box)[0] : farthest_from(geometry.center, plan.matter);
}

Map described(const MapPlan& plan, const Scene& scene, MapShape shape) {
  Map map;
  map.shape = shape;
  map.quantity = plan.quantity.description;
  map.unit = plan.units.name;
  describe_place(plan.geometry, scene.map, plan.snapshot, plan.units, map);
  map.tolerance = scene.tolerance;
  map.particles = plan.matter.count;
  return map;
}

CellMap draw_cells(const MapPlan& plan, const Scene& scene, MapShape shape,
                   const ComponentFields& fields, const LoadProgress& progress) {
  const auto tell = [&progress](double part) {
    if (progress) progress("adding up kernels", part);
  };
  const CellMatter matter = {
      scene.map,          plan.matter,
      plan.geometry,      plan.quantity,
      scene.kernel.width, fields.particles_per_drawn() * plan.quantity.weight_unit,
      scene.tolerance,    tell};
  if (shape == MapShape::voxels) return draw_voxels(matter);
  if (shape == MapShape::profile) return draw_profile(matter);
  if (shape == MapShape::histogram) return draw_histogram(matter, fields, plan.types.front());
  return draw_sky(matter, scene.image.width, scene.image.height);
}

void in_lengths_of_map(Map& map) {
  for (MapAxis& axis : map.axes) {
    if (!axis.unit.empty()) continue;
    axis.unit = map.length_unit;
    axis.first *= map.length_factor;
    axis.last *= map.length_factor;
  }
  if (!map.shell) return;
  for (double& radius : *map.shell)
    radius *= map.length_factor;
}

void take_cells(CellMap cells, const MapUnits& units, Map& map, std::vector<std::string>& notes) {
  map.width = cells.width;
  map.height = cells.height;
  map.axes = std::move(cells.axes);
  map.healpix = cells.healpix;
  map.shell = cells.shell;
  if (cells.sky) map.sky = cells.sky;
  map.floor = cells.floor;
  map.value_floor = cells.value_floor * units.factor;
  map.values = in_unit(cells.values, units, map.value_floor, notes);
  map.images = cells.images;
  map.bad_particles = cells.bad;
  if (map.shape == MapShape::healpix) map.view = "sky";
  in_lengths_of_map(map);
  notes.insert(notes.end(), cells.notes.begin(), cells.notes.end());
}

void note_rough_places(const PlacedParticles& placed, std::vector<std::string>& notes) {
  if (placed.rough == 0) return;
  notes.push_back(fmt::format(
      "{} of {} particles lie so far from the origin of coordinates that single precision has "
      "their "
      "places only to more than a pixel and their smoothing length; subtract the middle from "
      "positions first",
      placed.rough, placed.count()));
}

void draw_pixels(const MapPlan& plan, const Scene& scene, const ComponentFields& fields,
                 const DrawFrame& draw, Map& map, std::vector<std::string>& notes) {
  const MapSettings& settings = scene.map;
  const MapGeometry& geometry = plan.geometry;
  const PlacedParticles placed =
      place_particles(plan.matter, geometry, scene.kernel.width, settings.slice);
  note_rough_places(placed, notes);
  WeightedValues weighted(placed, plan.quantity, settings.floor, geometry, scene.kernel.width,
                          fields.particles_per_drawn());
  if (settings.noise) weighted.keep_weight_sums();
  const SumPicture picture = {geometry.width, geometry.height, scene.kernel.width, scene.tolerance};
  map.width = geometry.width;
  map.height = geometry.height;
  map.floor = weighted.floor();
  map.images = placed.count();
  map.bad_particles = placed.bad + weighted.bad();
  const VelocityChannels& channels = plan.quantity.channels;
  const bool is_cube = channels.count > 0;
  const std::vector<double> values =
      is_cube ? weighted.draw_channels(channels, picture, draw) : weighted.draw(picture, draw);
  if (is_cube)
    map.velocity = axis_of(channels, told_velocity(settings, plan.snapshot, plan.types.front()));
  map.value_floor = weighted.value_floor() * plan.units.factor;
  map.values = in_unit(values, plan.units, map.value_floor, notes);
  if (settings.noise) {
    map.effective_particles =
        draw_effective_particles(placed, weighted, picture, settings.floor, draw);
  }
}

bool have_weight(const MapPlan& plan) {
  for (std::size_t i = 0; i < plan.matter.count; ++i) {
    if (plan.quantity.weight[i] > 0) return true;
  }
  return false;
}

void note_particles(const MapPlan& plan, const MapSettings& settings, const Map& map,
                    std::vector<std::string>& notes) {
  if (plan.component.size_factor != 1 && settings.size_factor == 1) {
    notes.push_back(
        fmt::format("component \"{}\": size.factor {} is for pictures; the map has smoothing "
                    "lengths as they are "
                    "(map.size_factor)",
                    plan.component.name, plan.component.size_factor));
  }
  if (map.bad_particles > 0) {
    notes.push_back(std::to_string(map.bad_particles) +
                    " particles are left out of the map: their position, smoothing length, weight "
                    "or value is not finite, the length not above 0, or the weight below 0");
  }
  const VelocityChannels& channels = plan.quantity.channels;
  if (settings.velocity_range && channels.count > 0)
    note_outside(channels, plan.matter.count, notes);
  if (plan.matter.count > 0 && map.images == 0)
    notes.push_back("no particle reaches the map, which is empty");
  if (plan.matter.count > 0 && !have_weight(plan)) {
    notes.push_back(
        "all particles have the weight 0, and the map is empty; numbers below 1e-45 are read as 0: "
        "if theirs are, store them in a smaller unit");
  }
}

}  // namespace

Map draw_map(const Scene& written, const Snapshot& snapshot, const DrawFrame& draw,
             std::vector<std::string>& notes, const LoadProgress& progress) {
  const Scene one = scene_of_map(with_lengths_as_numbers(written, snapshot));
  const MapSettings& settings = one.map;
  const MapShape shape = shape_of(settings);
  check_quantity(settings);
  const Component& component = one.components.front();
  const PeriodicRegion region = find_region(one, component, snapshot, notes);
  OpenComponents open(one, snapshot, missing_sizes(one, progress), notes, region.box);
  ComponentFields& fields = open.fields().front();
  fields.select();
  MapPlan plan = {component, fields.snapshot_info(), {}, {}, {}, {}, {}};
  plan.types = present_types(component, plan.snapshot);
  plan.matter = read_matter(component, settings, fields);
  plan.geometry = geometry_of(one, shape, plan.matter, region);
  plan.quantity =
      read_quantity(settings, plan.geometry, fields, plan.types.front(), plan.matter.count);
  refuse_all_bad(plan.matter, plan.quantity, fields);
  plan.units = decide_units(settings, plan.snapshot, plan.types, plan.quantity.kind,
                            extent_of(plan, settings));
  Map map = described(plan, one, shape);
  if (is_made_of_cells(shape)) {
    take_cells(draw_cells(plan, one, shape, fields, progress), plan.units, map, notes);
  } else {
    draw_pixels(plan, one, fields, draw, map, notes);
  }
  note_particles(plan, settings, map, notes);
  return map;
}

}  // namespace splotchcl
