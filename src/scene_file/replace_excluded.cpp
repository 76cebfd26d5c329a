#include "scene_file/replace_excluded.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace splotchcl::scene_file {
namespace {

// Percentiles stand for a limit that is missing.
template <class Limits>
void replace_range(const std::string& label, const IsGiven& is_given, Limits& range) {
  if (!range.minimum || !range.maximum || !range.percentiles) return;
  const bool gives_minimum = is_given(label + ".min"), gives_maximum = is_given(label + ".max");
  if (is_given(label + ".percentiles")) {
    if (!gives_minimum) range.minimum.reset();
    if (!gives_maximum) range.maximum.reset();
  } else if (gives_minimum || gives_maximum) {
    range.percentiles.reset();
  }
}

void forget(const std::string& label, const IsGiven& is_given, Origins& origins) {
  for (const char* part : {".field", ".scaling", ".min", ".max", ".percentiles"}) {
    if (!is_given(label + part)) origins.where.erase(label + part);
  }
}

// Colours of the particles' own take the palette's place, unless the field is looked up in an
// absorption palette.
void replace_colors(const std::string& label, const IsGiven& is_given, Component& component,
                    Origins& origins) {
  const bool are_both = !component.color_vector.empty() && !component.color.field.empty();
  if (!are_both || !component.absorption_palette.empty()) return;
  const bool gives_vector = is_given(label + ".vector"), gives_field = is_given(label + ".field");
  if (gives_vector && !gives_field) {
    component.color = FieldMap();
    forget(label, is_given, origins);
  } else if (gives_field && !gives_vector) {
    component.color_vector.clear();
  }
}

}  // namespace

void replace_excluded(const IsGiven& is_given, Scene& scene, Origins& origins) {
  replace_range("map", is_given, scene.map);
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const std::string label = fmt::format("component.{}", i);
    replace_colors(label + ".color", is_given, scene.components[i], origins);
    replace_range(label + ".color", is_given, scene.components[i].color);
    replace_range(label + ".intensity", is_given, scene.components[i].intensity);
  }
}

}  // namespace splotchcl::scene_file
