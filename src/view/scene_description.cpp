#include "view/scene_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "load/derived_fields.h"
#include "sequence/list_sequence.h"
#include "splotchcl/camera.h"
#include "splotchcl/palette_file.h"

namespace splotchcl::view {
namespace {

using Json = nlohmann::json;

// Of a palette, from its first color to its last.
constexpr int samples = 17;

Json vector_json(const Vec3& v) {
  return {v.a[0], v.a[1], v.a[2]};
}

// null: left to the data.
Json optional_json(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

const char* name_of(Scaling scaling) {
  return scaling == Scaling::log ? "log" : scaling == Scaling::asinh ? "asinh" : "linear";
}

const char* name_of(ToneCurve tone) {
  return tone == ToneCurve::asinh ? "asinh" : tone == ToneCurve::filmic ? "filmic" : "linear";
}

const char* name_of(Projection projection) {
  switch (projection) {
    case Projection::orthographic:
      return "orthographic";
    case Projection::fisheye:
      return "fisheye";
    case Projection::equirectangular:
      return "equirectangular";
    case Projection::cube:
      return "cube";
    case Projection::perspective:
      break;
  }
  return "perspective";
}

// null: a rule that the page does not set.
Json absorption_json(const Absorption& absorption) {
  if (absorption.kind == Absorption::Kind::as_emission) return "emission";
  if (absorption.kind == Absorption::Kind::none) return "none";
  if (absorption.kind == Absorption::Kind::factor) return absorption.factor;
  return nullptr;
}

void add_component_settings(const Component& component, std::size_t i, Json& settings) {
  const std::string start = fmt::format("component.{}.", i);
  settings[start + "palette"] = component.palette;
  settings[start + "brightness"] = component.brightness;
  settings[start + "size.factor"] = component.size_factor;
  const Json absorption = absorption_json(component.absorption);
  if (!absorption.is_null()) settings[start + "absorption"] = absorption;
  if (component.color.field.empty()) return;
  settings[start + "color.field"] = component.color.field;
  settings[start + "color.scaling"] = name_of(component.color.scaling);
  settings[start + "color.min"] = optional_json(component.color.minimum);
  settings[start + "color.max"] = optional_json(component.color.maximum);
}

Json settings_json(const Scene& scene) {
  const Camera& camera = *scene.camera;
  Json settings = {
      {"camera.position", vector_json(camera.position)},
      {"camera.look_at", vector_json(camera.look_at)},
      {"camera.sky", vector_json(camera.sky)},
      {"camera.projection", name_of(camera.projection)},
      {"image.size", {scene.image.width, scene.image.height}},
      {"image.gamma", scene.image.gamma},
      {"tolerance", scene.tolerance},
      {"finish.exposure", optional_json(scene.finish.exposure)},
      {"finish.white", optional_json(scene.finish.white)},
      {"finish.tone", name_of(scene.finish.tone)},
      {"finish.saturation", scene.finish.saturation},
      {"finish.contrast", scene.finish.contrast},
      {"finish.color_bar.show", scene.finish.color_bar.show},
      {"finish.scale_bar.show", scene.finish.scale_bar.show},
  };
  if (camera.projection != Projection::cube) {
    settings["camera.field_of_view"] = field_of_view_degrees(camera);
  }
  for (std::size_t i = 0; i < scene.components.size(); ++i)
    add_component_settings(scene.components[i], i, settings);
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

Json components_json(const Scene& scene, const Snapshot& snapshot) {
  Json components = Json::array();
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const Component& component = scene.components[i];
    components.push_back(
        {{"name", component.name.empty() ? fmt::format("component {}", i + 1) : component.name},
         {"fields", fields_of(component, snapshot)},
         {"has_own_colors", !component.color_vector.empty()}});
  }
  return components;
}

// Those of a scene whose keyframes move nothing but the camera; a page cannot show others.
Json keyframes_json(const Scene& scene) {
  Json keyframes = Json::array();
  for (const Keyframe& keyframe : scene.path.keyframes) {
    Json settings = Json::object();
    for (const auto& [key, value] : keyframe.values) {
      settings[key] = Json::parse(value, nullptr, false);
      if (key.rfind("camera.", 0) != 0 || settings[key].is_discarded()) return Json::array();
    }
    keyframes.push_back({{"frame", keyframe.frame}, {"settings", settings}});
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
               {"palettes", palettes_json(opened)},
               {"keyframes", keyframes_json(opened)},
               {"fills_window", fills_window},
               {"has_path", opened.path.is_set()},
               {"scene_file", stem_of(snapshot) + "_view.toml"},
               {"picture_file", stem_of(snapshot) + "_view.png"}};
  if (info.redshift) json["redshift"] = *info.redshift;
  json["time"] = info.time;
  if (opened.time.is_set()) {
    json["times"] = times_json(opened);
    json["settings"]["time.index"] = opened.time.index;
  }
  // File names need not be UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace splotchcl::view
