#include "map/component_of_map.h"

#include <string>
#include <vector>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {

const Component& component_of_map(const Scene& scene) {
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

Scene scene_of_numbers(const Scene& scene, const Component& component) {
  Scene one = scene;
  one.components = {component};
  Component& only = one.components.front();
  only.color = {};
  only.intensity = {};
  only.color_vector.clear();
  one.finish = {};
  one.sort = {};
  return one;
}

}  // namespace splotchcl
