#include "scene_file/replace_excluded.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace splotchcl::scene_file {
namespace {

// Percentiles stand for a limit that is missing.
void replace_range(const std::string& label, const IsGiven& is_given, FieldMap& map) {
  if (!map.minimum || !map.maximum || !map.percentiles) return;
  const bool gives_minimum = is_given(label + ".min"), gives_maximum = is_given(label + ".max");
  if (is_given(label + ".percentiles")) {
    if (!gives_minimum) map.minimum.reset();
    if (!gives_maximum) map.maximum.reset();
  } else if (gives_minimum || gives_maximum) {
    map.percentiles.reset();
  }
}

}  // namespace

void replace_excluded(const IsGiven& is_given, Scene& scene) {
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const std::string label = fmt::format("component.{}", i);
    replace_range(label + ".color", is_given, scene.components[i].color);
    replace_range(label + ".intensity", is_given, scene.components[i].intensity);
  }
}

}  // namespace splotchcl::scene_file
