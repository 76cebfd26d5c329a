#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "finish/ticks.h"
#include "load/derived_fields.h"
#include "scene_file/keys.h"
#include "sequence/snapshot_source.h"
#include "snapshot/field_names.h"
#include "splotchcl/camera.h"
#include "splotchcl/palette_file.h"
#include "view/answers.h"
#include "view/requests/page_messages.h"
#include "view/view_scene.h"

namespace splotchcl::view {
namespace {

using Json = nlohmann::json;

// Of a palette, from its first color to its last.
constexpr int samples = 17;

// "component.12.palette" -> "component.palette", as the table of keys has it.
std::string without_number(const std::string& key, std::size_t component) {
  const std::string start = fmt::format("component.{}.", component);
  return key.rfind(start, 0) == 0 ? "component." + key.substr(start.size()) : key;
}

// null: left to the data, or to a default that is no value.
Json value_json(const Scene& scene, const std::string& key) {
  const std::size_t component = component_of_key(scene, key).value_or(0);
  const scene_file::Key* const known = scene_file::find_key(without_number(key, component));
  const std::optional<std::string> text = known->get(scene, component);
  if (!text || *text == "\"auto\"") return nullptr;
  Json value = Json::parse(*text, nullptr, false);
  return value.is_discarded() ? Json() : value;
}

// Every key that a page may set.
Json settings_json(const Scene& scene) {
  Json settings = Json::object();
  for (const std::string& key : settable_keys(scene.components.size()))
    settings[key] = value_json(scene, key);
  const Camera& camera = *scene.camera;
  settings.erase("camera.field_of_view");
  if (camera.projection != Projection::cube) {
    settings["camera.field_of_view"] = field_of_view_degrees(camera);
  }
  if (!scene.time.is_set()) settings.erase("time.index");
  return settings;
}

bool is_identifier(const std::string& field) {
  return field == "id" || field == "position";
}

std::set<std::string> fields_of(const ParticleTypeInfo& type) {
  std::set<std::string> fields;
  for (const FieldInfo& field : type.fields) {
    if (!is_identifier(field.name)) fields.insert(field.name);
  }
  for (const std::string& field : derivable_fields(type))
    fields.insert(field);
  return fields;
}

// Those that all of its types have; of a component with a snapshot of its own only the one that it
// is drawn by.
std::set<std::string> fields_of(const Component& component, const Snapshot& snapshot) {
  std::optional<std::set<std::string>> common;
  if (component.snapshot.empty()) {
    for (const int type : component.types) {
      const ParticleTypeInfo* const info = snapshot.info().find_type(type);
      if (info == nullptr) continue;
      const std::set<std::string> own = fields_of(*info);
      if (!common) common = own;
      std::set<std::string> both;
      std::set_intersection(common->begin(), common->end(), own.begin(), own.end(),
                            std::inserter(both, both.end()));
      common = both;
    }
  }
  std::set<std::string> fields = common.value_or(std::set<std::string>());
  if (!component.color.field.empty()) fields.insert(component.color.field);
  return fields;
}

// Of fields whose unit is known, by the first type that has them.
Json units_json(const Component& component, const std::set<std::string>& fields,
                const Snapshot& snapshot) {
  Json units = Json::object();
  const int first = component.types.empty() ? 0 : component.types.front();
  const ParticleTypeInfo* const type = snapshot.info().find_type(first);
  if (type == nullptr || !component.snapshot.empty()) return units;
  for (const std::string& field : fields) {
    const std::string unit = unit_of(*type, field);
    if (!unit.empty()) units[field] = unit;
  }
  return units;
}

Json component_json(const Component& component, std::size_t number, const Snapshot& snapshot) {
  const std::set<std::string> fields = fields_of(component, snapshot);
  return {
      {"name", component.name.empty() ? fmt::format("component {}", number + 1) : component.name},
      {"fields", fields},
      {"units", units_json(component, fields, snapshot)},
      {"has_own_colors", !component.color_vector.empty()}};
}

Json components_json(const Scene& scene, const Snapshot& snapshot) {
  Json components = Json::array();
  for (std::size_t i = 0; i < scene.components.size(); ++i)
    components.push_back(component_json(scene.components[i], i, snapshot));
  return components;
}

// The types of particles that there are, and how many of each.
Json particles_json(const Snapshot& snapshot) {
  Json particles = Json::array();
  for (const ParticleTypeInfo& type : snapshot.info().types)
    particles.push_back({{"type", particle_type_name(type.type)}, {"count", type.count}});
  return particles;
}

// With the component's number, as the page has it.
std::string numbered_key(const Scene& scene, const std::string& key) {
  const std::optional<std::size_t> component = component_of_key(scene, key);
  if (!component) return key;
  const std::size_t start = std::string_view("component.").size();
  return fmt::format("component.{}.{}", *component, key.substr(key.find('.', start) + 1));
}

// None for a keyframe with something that a page may not set.
std::optional<Json> keyframe_json(const Scene& scene, const Keyframe& keyframe) {
  Json settings = Json::object();
  for (const auto& [word, text] : keyframe.values) {
    const std::string key = numbered_key(scene, word);
    Json value = Json::parse(text, nullptr, false);
    if (!is_settable(key) || value.is_discarded()) return std::nullopt;
    settings[key] = std::move(value);
  }
  return Json{{"frame", keyframe.frame},
              {"settings", settings},
              {"ease", keyframe.is_eased},
              {"dwell", keyframe.dwell}};
}

// None where the page cannot show them all.
Json keyframes_json(const Scene& scene) {
  Json keyframes = Json::array();
  for (const Keyframe& keyframe : scene.path.keyframes) {
    const std::optional<Json> json = keyframe_json(scene, keyframe);
    if (!json) return Json::array();
    keyframes.push_back(*json);
  }
  return keyframes;
}

// Linear light, 0 to 1.
Json colors_json(const Palette& palette) {
  Json colors = Json::array();
  for (int i = 0; i < samples; ++i) {
    const auto color = sample_knots(palette.emission, static_cast<double>(i) / (samples - 1));
    for (const double channel : color)
      colors.push_back(std::round(1e4 * std::clamp(channel, 0.0, 1.0)) / 1e4);
  }
  return colors;
}

Json palettes_json(const Scene& scene) {
  std::vector<std::string> names;
  for (const PaletteInfo& palette : list_palettes())
    names.push_back(palette.name);
  for (const Component& component : scene.components) {
    const bool is_new = std::find(names.begin(), names.end(), component.palette) == names.end();
    if (is_new) names.push_back(component.palette);
  }
  Json palettes = Json::array();
  for (const std::string& name : names)
    palettes.push_back({{"name", name}, {"colors", colors_json(load_palette(name))}});
  return palettes;
}

// First and last moment of a sequence.
Json times_json(const Scene& scene) {
  const std::vector<ListedSnapshot> snapshots = list_sequence(scene.time);
  return {snapshots.front().index, snapshots.back().index};
}

std::string stem_of(const Snapshot& snapshot) {
  const std::string stem = snapshot.info().files.front().stem().string();
  return stem.empty() ? "view" : stem;
}

}  // namespace

std::string describe_scene(const Scene& opened, const Snapshot& snapshot, bool fills_window) {
  const SnapshotInfo& info = snapshot.info();
  Json json = {{"type", "opened"},
               {"name", info.files.front().filename().string()},
               {"settings", settings_json(opened)},
               {"components", components_json(opened, snapshot)},
               {"particles", particles_json(snapshot)},
               {"length_unit", length_unit(info)},
               {"palettes", palettes_json(opened)},
               {"keyframes", keyframes_json(opened)},
               {"fills_window", fills_window},
               {"has_path", opened.path.is_set()},
               {"film_file", stem_of(snapshot) + "_view.mp4"},
               {"scene_file", stem_of(snapshot) + "_view.toml"},
               {"picture_file", stem_of(snapshot) + "_view.png"}};
  if (info.redshift) json["redshift"] = *info.redshift;
  json["time"] = info.time;
  if (opened.time.is_set()) json["times"] = times_json(opened);
  // File names need not be UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

bool is_of_look(const Scene& opened, const Scene& look, const std::string& key) {
  const std::optional<std::size_t> component = component_of_key(look, key);
  if (!component) return key.rfind("finish.", 0) == 0 || key == "image.background";
  return *component < opened.components.size() &&
         opened.components[*component].types == look.components[*component].types &&
         key.find(".select.") == std::string::npos;
}

}  // namespace

std::string describe_look(const Scene& opened, const Scene& look) {
  Json settings = settings_json(look);
  Json own = Json::object();
  for (const auto& [key, value] : settings.items()) {
    if (is_of_look(opened, look, key)) own[key] = value;
  }
  return own.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::set<std::string> keys_of_keyframes(const Scene& scene) {
  std::set<std::string> keys;
  for (const Keyframe& keyframe : scene.path.keyframes) {
    for (const auto& [word, text] : keyframe.values) {
      const std::string key = numbered_key(scene, word);
      if (is_settable(key)) keys.insert(key);
    }
  }
  return keys;
}

std::string describe_values(const Scene& scene, const std::set<std::string>& keys) {
  Json values = Json::object();
  for (const std::string& key : keys)
    values[key] = value_json(scene, key);
  return values.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string describe_component(const Component& component, const Snapshot& snapshot) {
  Scene scene;
  scene.components = {component};
  Json settings = Json::object();
  for (const std::string& key : settable_keys(1)) {
    constexpr std::string_view start = "component.0.";
    if (key.rfind(start, 0) == 0) settings[key.substr(start.size())] = value_json(scene, key);
  }
  Json json = component_json(component, 0, snapshot);
  json["settings"] = settings;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace splotchcl::view
