#include <algorithm>
#include <cstddef>

#include "scene/scalar_map.h"
#include "splotchcl/load.h"

namespace splotchcl {
namespace {

bool is_decided(const FieldMap& map) {
  return map.field.empty() || (map.minimum && map.maximum);
}

void fix(FieldMap& map, const ScalarMap& decided) {
  if (is_decided(map)) return;
  if (!map.minimum) map.minimum = unscaled(decided.minimum, map.scaling);
  if (!map.maximum) map.maximum = unscaled(decided.maximum, map.scaling);
  map.percentiles.reset();
}

void fix(Component& component, const DecidedComponent& decided) {
  if (!component.weight) component.weight = decided.weight;
  if (!decided.has_particles) return;
  fix(component.color, decided.color);
  fix(component.intensity, decided.intensity);
  if (!component.reference_column && decided.is_seen) {
    component.reference_column = decided.reference_column * decided.particles_per_drawn;
  }
}

}  // namespace

Scene fixed_scene(const DecidedScene& decided) {
  Scene scene = decided.scene;
  for (std::size_t i = 0; i < scene.components.size(); ++i)
    fix(scene.components[i], decided.components.at(i));
  return scene;
}

bool is_decided(const Scene& scene) {
  const bool has_all =
      std::all_of(scene.components.begin(), scene.components.end(), [](const Component& component) {
        return component.weight && component.reference_column && is_decided(component.color) &&
               is_decided(component.intensity);
      });
  return scene.camera && has_all;
}

}  // namespace splotchcl
