#include "scene_file/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "common/words.h"
#include "formula/formula.h"
#include "scene/constants.h"
#include "scene_file/check.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/camera.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"

namespace splotchcl::scene_file {
namespace {

// Whether the settings give the key of this label, such as "component.0.color.min".
using IsGiven = std::function<bool(const std::string& label)>;

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

// Panoramas and cubes have seams, at which a glow would end.
void stop_glow(const Scene& before, const Scene& suggested, const IsGiven& is_given, Scene& scene) {
  const bool is_suggested = before.finish.bloom == suggested.finish.bloom;
  const Projection projection = scene.camera->projection;
  const bool has_seams =
      projection == Projection::equirectangular || projection == Projection::cube;
  if (is_suggested && has_seams && !is_given("finish.bloom")) scene.finish.bloom = 0;
}

// After settings have changed a scene: what was suggested for the scene before them, and nobody
// gave, gives way where it does not belong to the scene any more.
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

// After settings have changed a scene: values that were there before go where those that the
// settings give exclude them, for what Key::excludes cannot say. Values that settings give are left
// to check_scene.
void replace_excluded(const IsGiven& is_given, Scene& scene, Origins& origins) {
  replace_range("map", is_given, scene.map);
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const std::string label = fmt::format("component.{}", i);
    replace_colors(label + ".color", is_given, scene.components[i], origins);
    replace_range(label + ".color", is_given, scene.components[i].color);
    replace_range(label + ".intensity", is_given, scene.components[i].intensity);
  }
}

// The innermost known table of a path: {"camera", "fov"} of "camera.fov".
[[noreturn]] void refuse_unknown_path(const KeyAddress& address, const std::string& where) {
  std::string table = address.path;
  do {
    const std::size_t dot = table.rfind('.');
    table.resize(dot == std::string::npos ? 0 : dot);
  } while (!is_table(table));
  const std::size_t rest = address.path.size() - table.size();
  KeyAddress parent = address;
  parent.path = table;
  parent.label = table.empty() ? "" : address.label.substr(0, address.label.size() - rest);
  refuse_unknown_key(parent, address.path.substr(table.empty() ? 0 : table.size() + 1), where);
}

bool is_known(const std::string& path) {
  return find_key(path) != nullptr || is_table(path);
}

// A table's entries in the order of the file, so that its first mistake is reported first.
std::vector<std::pair<const toml::key*, const toml::node*>> in_file_order(
    const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (auto it = table.cbegin(); it != table.cend(); ++it) {
    entries.emplace_back(&it->first, &it->second);
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  return entries;
}

void center_on(const Vec3& center, Camera& camera) {
  const Vec3 shift = center - camera.look_at;
  camera.position += shift;
  camera.look_at = center;
}

// From a distance at which the width is seen under 45 degrees, or far above all matter where the
// distance does not count.
void look_from_above(const Vec3& center, double width, Camera& camera) {
  const bool is_parallel = camera.projection == Projection::orthographic;
  const double distance = width * (is_parallel ? 1000 : 0.5 / std::tan(pi / 8));
  camera.look_at = center;
  camera.position = center + Vec3{{0, 0, distance}};
  camera.sky = {{0, 1, 0}};
}

}  // namespace

SceneBuilder::SceneBuilder(Scene scene, const std::string& name_for_messages)
    : scene_(std::move(scene)) {
  origins_.name = name_for_messages;
}

void SceneBuilder::read_text(const std::string& text, const Scene* suggested) {
  is_reading_file_ = true;
  assigned_.clear();
  if (const int line = find_deep_key(text); line > 0) {
    throw UsageError(fmt::format(
        "{}:{}: found a key of very many parts (a.b.c...), expected one of a scene file's keys",
        origins_.name, line));
  }
  toml::table root;
  try {
    root = parse_toml(text);
  } catch (const toml::parse_error& error) {
    throw UsageError(fmt::format("{}: found no valid TOML, expected a scene file: {}",
                                 where_in_file(error.source()),
                                 one_line(std::string(error.description()), 300)));
  }
  const Scene before = scene_;
  assign_table({}, {root, origins_.name});
  refuse_exclusions();
  if (suggested != nullptr) make_way(before, suggested);
  center_camera();
}

void SceneBuilder::apply_settings(const std::vector<std::string>& settings,
                                  const Scene* suggested) {
  is_reading_file_ = false;
  assigned_.clear();
  const Scene before = scene_;
  for (const std::string& setting : settings)
    apply_setting(setting);
  refuse_exclusions();
  make_way(before, suggested);
  center_camera();
}

// For what was assigned.
void SceneBuilder::make_way(const Scene& before, const Scene* suggested) {
  const IsGiven is_given = [this](const std::string& label) { return is_assigned(label); };
  if (suggested != nullptr) give_way(before, *suggested, is_given, scene_);
  replace_excluded(is_given, scene_, origins_);
}

Scene SceneBuilder::finish() const {
  if (camera_is_new_) {
    for (const char* label : {"camera.position", "camera.look_at"}) {
      if (origins_.contains(label)) continue;
      refuse(origins_.at("camera"), label, "nothing",
             find_key(label)->expected + ", since a scene with a camera says where it is");
    }
  }
  check_scene(scene_, origins_);
  return scene_;
}

void SceneBuilder::apply_setting(const std::string& setting) {
  require_utf8(setting);
  const Setting parts = split_setting(setting);
  const std::string where = fmt::format("setting \"{}\"", one_line(setting));
  const KeyAddress address = locate(parts.key, scene_, where);
  if (!is_known(address.path)) refuse_unknown_path(address, where);
  const toml::table table = parse_value(parts.text);
  assign(address, {*table.get("value"), where, &parts.text});
}

void SceneBuilder::assign(const KeyAddress& address, const Value& value) {
  if (const Key* key = find_key(address.path)) {
    assign_key(*key, address, value);
  } else if (address.label == "component") {
    assign_components(value);
  } else {
    assign_table(address, value);
  }
}

void SceneBuilder::assign_key(const Key& key, const KeyAddress& address, const Value& value) {
  if (is_assigned(address.label)) {
    refuse(value.where, address.label, "it for the second time", "each key once");
  }
  need_camera(address, value.where);
  need_stereo(address);
  bool is_set = false;
  try {
    is_set = key.set(scene_, address.component, value.node);
    if (!is_set && value.bare_text != nullptr) {
      is_set = key.set(scene_, address.component, toml::value<std::string>(*value.bare_text));
    }
  } catch (const UsageError& error) {  // a formula that is none
    throw UsageError(fmt::format("{}: key {}: {}", value.where, address.label, error.what()));
  }
  if (!is_set) refuse(value.where, address.label, describe(value.node), key.expected);
  origins_.where[address.label] = value.where;
  assigned_.push_back({&key, address});
}

bool SceneBuilder::is_assigned(const std::string& label) const {
  return std::any_of(assigned_.begin(), assigned_.end(), [&label](const Assignment& assignment) {
    return assignment.address.label == label;
  });
}

void SceneBuilder::assign_table(const KeyAddress& address, const Value& value) {
  const toml::table* table = value.node.as_table();
  if (table == nullptr) {
    refuse(
        value.where, address.label, describe(value.node),
        fmt::format("a table with keys such as {}", fmt::join(names_in_table(address.path), ", ")));
  }
  need_camera(address, value.where);
  need_stereo(address);
  for (const auto& [key, node] : in_file_order(*table)) {
    const std::string name(key->str());
    const std::string where = is_reading_file_ ? where_in_file(key->source()) : value.where;
    const KeyAddress child = {join(address.path, name), join(address.label, name),
                              address.component};
    const bool is_one_name = name.find('.') == std::string::npos && !name.empty();
    if (!is_one_name || !is_known(child.path)) refuse_unknown_key(address, name, where);
    assign(child, {*node, where});
  }
}

void SceneBuilder::assign_components(const Value& value) {
  const toml::array* components = value.node.as_array();
  if (!is_reading_file_ || components == nullptr || !components->is_array_of_tables()) {
    refuse(value.where, "component", describe(value.node),
           is_reading_file_ ? "a table for each component: write [[component]] above its keys"
                            : "the component's number or name too, such as component.0.palette");
  }
  constexpr std::size_t most = 1000;
  if (components->size() > most) {
    refuse(where_in_file((*components)[most].source()), "component",
           fmt::format("{} components", components->size()), fmt::format("at most {}", most));
  }
  for (const toml::node& node : *components) {
    const std::size_t i = scene_.components.size();
    scene_.components.emplace_back();
    assign_table({"component", fmt::format("component.{}", i), i},
                 {node, where_in_file(node.source())});
  }
}

void SceneBuilder::need_camera(const KeyAddress& address, const std::string& where) {
  const bool is_of_camera = address.path.substr(0, address.path.find('.')) == "camera";
  if (!is_of_camera || scene_.camera) return;
  scene_.camera.emplace();
  camera_is_new_ = true;
  origins_.where["camera"] = where;
}

// An empty [stereo] asks for two eyes, too.
void SceneBuilder::need_stereo(const KeyAddress& address) {
  const bool is_of_stereo = address.path.substr(0, address.path.find('.')) == "stereo";
  if (is_of_stereo && !scene_.stereo) scene_.stereo.emplace();
}

void SceneBuilder::refuse_exclusions() const {
  for (const Assignment& given : assigned_) {
    for (const Assignment& other : assigned_) {
      const auto& excluded = given.key->excludes;
      const bool is_excluded =
          given.address.component == other.address.component &&
          std::find(excluded.begin(), excluded.end(), other.key->path) != excluded.end();
      if (!is_excluded) continue;
      refuse(origins_.at(other.address.label), other.address.label,
             fmt::format("it beside {}", given.address.label), "only one of the two");
    }
  }
}

void SceneBuilder::center_camera() {
  if (!scene_.camera || !scene_.camera->center) return;
  Camera& camera = *scene_.camera;
  const bool has_place = !camera_is_new_ || origins_.contains("camera.position") ||
                         origins_.contains("camera.look_at");
  if (!has_place && !camera.width) {
    refuse(origins_.at("camera.center"), "camera.center",
           "it in a camera without a place and without a width", "camera.width as well");
  }
  if (has_place) {
    center_on(*camera.center, camera);
  } else {
    look_from_above(*camera.center, *camera.width, camera);
    for (const char* label : {"camera.position", "camera.look_at"})
      origins_.where[label] = origins_.at("camera.center");
  }
  camera.center.reset();
}

std::string SceneBuilder::where_in_file(const toml::source_region& region) const {
  return fmt::format("{}:{}", origins_.name, region.begin.line);
}

}  // namespace splotchcl::scene_file
