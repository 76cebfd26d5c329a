#include "scene_file/give_way.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <string>

#include "formula/formula.h"
#include "splotchcl/camera.h"

namespace splotchcl::scene_file {
namespace {

// A range that was found in the data of one field is none of another field's; and of a formula it
// is the user who says whether it is scaled once more.
void give_way(const FieldMap& before, const FieldMap& suggested, const std::string& label,
              const IsGiven& is_given, FieldMap& map) {
  if (map.field == before.field || before.field != suggested.field) return;
  const bool is_suggested_minimum = before.minimum == suggested.minimum;
  const bool is_suggested_maximum = before.maximum == suggested.maximum;
  const bool is_suggested_scaling = before.scaling == suggested.scaling;
  if (Formula::may_be(map.field) && is_suggested_scaling && !is_given(label + ".scaling"))
    map.scaling = Scaling::linear;
  if (is_suggested_minimum && !is_given(label + ".min")) map.minimum.reset();
  if (is_suggested_maximum && !is_given(label + ".max")) map.maximum.reset();
}

// A projection of wide angles has a field of view of its own; the suggested one frames what the
// others show.
void give_way(const Camera& before, const Camera& suggested, const IsGiven& is_given,
              Camera& camera) {
  const bool is_suggested =
      before.field_of_view_degrees == suggested.field_of_view_degrees && !before.width;
  if (camera.projection == before.projection || !is_wide_angle(camera.projection)) return;
  if (is_suggested && !is_given("camera.field_of_view") && !is_given("camera.width"))
    camera.field_of_view_degrees.reset();
}

// Whether nothing tells how the picture is turned.
bool looks_along_its_sky(const Camera& camera) {
  using namespace boost::qvm;
  constexpr double almost = 1e-6;
  const Vec3 view = camera.look_at - camera.position;
  return mag(cross(view, camera.sky)) <= almost * mag(view) * mag(camera.sky);
}

// The sky that was suggested is one of two axes; where the camera now looks along it, it is the
// other one.
void turn_sky(const Camera& before, const Camera& suggested, const IsGiven& is_given,
              Camera& camera) {
  const bool is_suggested = before.sky == suggested.sky && !is_given("camera.sky");
  if (!is_suggested || !looks_along_its_sky(camera)) return;
  camera.sky = {{0, 1, 0}};
  if (looks_along_its_sky(camera)) camera.sky = {{0, 0, 1}};
}

// No panorama reaches beyond the poles: sides that were suggested make room for one of so many
// degrees.
void give_way(const ImageSettings& before, const ImageSettings& suggested, const IsGiven& is_given,
              double degrees, ImageSettings& image) {
  constexpr double from_pole_to_pole = 180;
  const double ratio = degrees / from_pole_to_pole;
  const bool gives_size = is_given("image.size");
  const bool gives_width = gives_size || is_given("image.width") || before.width != suggested.width;
  const bool gives_height =
      gives_size || is_given("image.height") || before.height != suggested.height;
  if (!gives_height) {
    const double highest = std::max(1.0, std::floor(image.width / ratio));
    image.height = static_cast<int>(std::min<double>(image.height, highest));
  } else if (!gives_width) {
    image.width = std::max(image.width, static_cast<int>(std::ceil(image.height * ratio)));
  }
}

}  // namespace

namespace {

// Panoramas and cubes have seams, at which a glow would end.
void stop_glow(const Scene& before, const Scene& suggested, const IsGiven& is_given, Scene& scene) {
  const bool is_suggested = before.finish.bloom == suggested.finish.bloom;
  const Projection projection = scene.camera->projection;
  const bool has_seams =
      projection == Projection::equirectangular || projection == Projection::cube;
  if (is_suggested && has_seams && !is_given("finish.bloom")) scene.finish.bloom = 0;
}

}  // namespace

void give_way(const Scene& before, const Scene& suggested, const IsGiven& is_given, Scene& scene) {
  if (scene.camera) stop_glow(before, suggested, is_given, scene);
  if (before.camera && suggested.camera) {
    give_way(*before.camera, *suggested.camera, is_given, *scene.camera);
    turn_sky(*before.camera, *suggested.camera, is_given, *scene.camera);
  }
  if (scene.camera && scene.camera->projection == Projection::equirectangular) {
    const double degrees = field_of_view_degrees(*scene.camera);
    give_way(before.image, suggested.image, is_given, degrees, scene.image);
  }
  const std::size_t count = std::min(scene.components.size(), suggested.components.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Component &old = before.components[i], &first = suggested.components[i];
    Component& component = scene.components[i];
    const std::string label = fmt::format("component.{}", i);
    give_way(old.color, first.color, label + ".color", is_given, component.color);
    give_way(old.intensity, first.intensity, label + ".intensity", is_given, component.intensity);
  }
}

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
  const bool gives_vector = is_given(label + ".vector"),
             gives_field = is_given(label + ".field") || is_given(label + ".formula");
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
