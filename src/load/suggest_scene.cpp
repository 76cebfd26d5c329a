// The scene that is drawn when only a snapshot is given. Every choice here is one of
// taste, made by looking at pictures; a scene file overrides any of it.
#include <algorithm>
#include <cmath>

#include "common/decimals.h"
#include "load/suggest_scene_camera.h"
#include "scene/statistics.h"
#include "snapshot/field_names.h"
#include "snapshot/particle_types.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {
namespace {

constexpr int gas = 0, halo = 1, stars = 4;

// Columns of matter span far more than a display does: a bright picture's dark parts need
// lifting.
constexpr double gamma = 1.5;

// Powers of ten, or parts of the unit on a linear scale, that a field must span to give
// a picture colours.
constexpr double smallest_span = 0.05;

// Three digits: a limit that a user may want to read and change.
double rounded(double value) {
  return value == 0 ? 0 : round_to_decimals(value, decimals_for(value, 3));
}

// The field with its limits spelled out, if the type has it and it has something to show.
std::optional<FieldMap> varying_field(const Snapshot& snapshot, const ParticleTypeInfo& type,
                                      const std::string& field, Scaling scaling) {
  const FieldInfo* const info = find_field(type, field);
  if (info == nullptr || info->values_per_particle != 1) return std::nullopt;
  const auto range = bulk_range(snapshot.read(type.type, field), scaling);
  if (!range) return std::nullopt;
  const double scale = scaling == Scaling::log ? 1.0 : std::abs(range->maximum);
  if (!(range->maximum - range->minimum > smallest_span * scale)) return std::nullopt;
  FieldMap map{field, scaling, {}, {}};
  const bool is_log = scaling == Scaling::log;
  map.minimum = rounded(is_log ? std::pow(10, range->minimum) : range->minimum);
  map.maximum = rounded(is_log ? std::pow(10, range->maximum) : range->maximum);
  return map;
}

// load_frame estimates it where the file has none; its range is not known before.
FieldMap estimated_density(Scaling scaling) {
  return {"density", scaling, {}, {}};
}

Component component_for(const ParticleTypeInfo& type) {
  Component component;
  component.name = particle_type_name(type.type);
  component.types = {type.type};
  component.weight = has_masses(type) ? WeightModel::mass : WeightModel::constant;
  return component;
}

Component gas_component(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  Component component = component_for(type);
  for (const char* const heat : {"temperature", "internal_energy"}) {
    if (const auto map = varying_field(snapshot, type, heat, Scaling::log)) {
      component.color = *map;
      component.palette = "hot_gas";
      return component;
    }
  }
  if (const auto map = varying_field(snapshot, type, "density", Scaling::log)) {
    component.color = *map;
    component.palette = "gas";
    return component;
  }
  // Neither heat nor density: initial conditions, whose matter is still so even that every
  // line of sight shows the same. What is denser than the rest must stand out.
  component.color = estimated_density(Scaling::log);
  component.intensity = estimated_density(Scaling::linear);
  component.palette = "hot_gas";
  component.brightness = 0.6;
  return component;
}

Component star_component(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  Component component = component_for(type);
  component.palette = "stars";
  component.color = varying_field(snapshot, type, "stellar_age", Scaling::linear)
                        .value_or(estimated_density(Scaling::log));
  return component;
}

// Discs and stars are bright against the halo that they lie in, which is but a glow
// around them; dark matter by itself is the picture.
Component collisionless_component(const Snapshot& snapshot, const ParticleTypeInfo& type) {
  if (type.type == stars) return star_component(snapshot, type);
  const bool is_alone = snapshot.info().types.size() == 1;
  Component component = component_for(type);
  component.color = estimated_density(Scaling::log);
  component.palette = type.type == halo ? "halo" : "hot_gas";
  if (!is_alone) component.brightness = type.type == halo ? 0.2 : 2.5;
  return component;
}

// Gas with the stars in it; dark matter beside gas would only veil it.
std::vector<Component> choose_components(const Snapshot& snapshot) {
  std::vector<Component> components;
  const SnapshotInfo& info = snapshot.info();
  if (const ParticleTypeInfo* const type = info.find_type(gas)) {
    components.push_back(gas_component(snapshot, *type));
    if (const ParticleTypeInfo* const star_type = info.find_type(stars)) {
      components.push_back(star_component(snapshot, *star_type));
    }
    return components;
  }
  for (const ParticleTypeInfo& type : info.types) {
    components.push_back(collisionless_component(snapshot, type));
  }
  return components;
}

std::vector<int> types_of(const std::vector<Component>& components) {
  std::vector<int> types;
  for (const Component& component : components) {
    types.insert(types.end(), component.types.begin(), component.types.end());
  }
  return types;
}

}  // namespace

Scene suggest_scene(const Snapshot& snapshot) {
  const SnapshotInfo& info = snapshot.info();
  if (info.types.empty()) {
    throw DataError(info.files.front().string() +
                    ": the snapshot holds no particles, expected some to draw");
  }
  Scene scene;
  scene.snapshot = info.files.front().string();
  scene.image.gamma = gamma;
  scene.components = choose_components(snapshot);
  scene.camera =
      suggest_camera(snapshot, types_of(scene.components), scene.image.width, scene.image.height);
  return scene;
}

}  // namespace splotchcl
