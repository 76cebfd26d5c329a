#include "open_scene/short_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <iterator>
#include <sstream>
#include <utility>

#include "common/words.h"
#include "formula/selection.h"
#include "load/type_fields.h"
#include "map/place.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/map.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

// As settings write it: alone, or in quotes.
std::string value_of(const std::string& setting) {
  const std::string text = trimmed(setting.substr(setting.find('=') + 1));
  const bool is_quoted = text.size() > 1 && text.front() == text.back() &&
                         (text.front() == '"' || text.front() == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<int> read_types(const std::string& text) {
  std::vector<int> types;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    word = trimmed(word);
    const auto number = parse_number(word);
    const auto type = number ? std::optional(static_cast<int>(*number)) : find_particle_type(word);
    const bool is_type = type && *type >= 0 && *type < particle_type_limit &&
                         (!number || static_cast<double>(*type) == *number);
    if (!is_type) {
      throw UsageError(fmt::format(
          "types: found \"{}\", expected particle types, such as gas,stars or 0,4", text));
    }
    types.push_back(*type);
  }
  return types;
}

bool take(const std::string& key, const std::string& setting, ShortKeys& keys) {
  const std::string value = value_of(setting);
  if (key == "types") {
    keys.types = read_types(value);
  } else if (key == "where") {
    parse_condition(value, "where");
    keys.where.push_back(value);
  } else if (key == "field") {
    keys.field = value;
  } else if (key == "palette") {
    keys.palette = value;
  } else if (key == "center") {
    keys.center = value;
  } else if (key == "width") {
    keys.width = value;
  } else {
    return false;
  }
  if (!value.empty()) return true;
  throw UsageError(fmt::format("{}: found nothing, expected a value", key));
}

bool is_wanted(const ShortKeys& keys, int type) {
  return std::count(keys.types.begin(), keys.types.end(), type) > 0;
}

std::string names_of_drawn(const Scene& scene) {
  std::vector<std::string> names;
  for (const Component& component : scene.components) {
    for (const int type : component.types) {
      const std::string name = particle_type_name(type);
      if (std::count(names.begin(), names.end(), name) == 0) names.push_back(name);
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_there_are(const ShortKeys& keys, const Snapshot& snapshot) {
  for (const int type : keys.types) {
    if (snapshot.info().find_type(type) != nullptr) continue;
    std::vector<std::string> names;
    for (const ParticleTypeInfo& present : snapshot.info().types)
      names.push_back(particle_type_name(present.type));
    throw UsageError(fmt::format(
        "types: found {}, of which {} has no particles, expected some of {}",
        particle_type_name(type), snapshot.info().files.front().string(), fmt::join(names, ", ")));
  }
}

// What covers a wide range, by its name: a palette shows its decades.
Scaling scaling_of(const std::string& field) {
  constexpr std::array<const char*, 7> of_many_decades = {
      "density", "temperature",         "internal_energy",    "pressure",
      "entropy", "velocity_dispersion", "star_formation_rate"};
  const std::string canonical = canonical_field_name(field);
  const bool is_wide = std::any_of(of_many_decades.begin(), of_many_decades.end(),
                                   [&](const char* name) { return canonical == name; });
  return is_wide ? Scaling::log : Scaling::linear;
}

// Which of these fields a component's particles do not all have, and cannot derive.
std::vector<std::string> lacking_fields(const Component& component,
                                        const std::vector<std::string>& names,
                                        const Snapshot& snapshot) {
  std::vector<std::string> lacking;
  if (!component.snapshot.empty()) return lacking;
  for (const int type : component.types) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    if (info == nullptr) continue;
    const TypeFields fields(snapshot, *info, particle_type_name(type), {{0, 0, 0}},
                            [](const std::string&) {});
    std::copy_if(names.begin(), names.end(), std::back_inserter(lacking),
                 [&](const std::string& name) {
                   return canonical_field_name(name) != "id" && !fields.has_plain(name);
                 });
  }
  return lacking;
}

bool have_fields(const Component& component, const std::vector<std::string>& names,
                 const Snapshot& snapshot) {
  return lacking_fields(component, names, snapshot).empty();
}

// What does not have the fields of a condition does not fulfil it. Where nothing has them, the
// first component's refusal says so.
void keep_where(const std::string& condition, SceneWithSnapshot& opened) {
  const std::vector<std::string> names = parse_condition(condition, "where").fields();
  std::vector<Component> kept, lacking;
  for (const Component& component : opened.scene.components) {
    const bool has_all = have_fields(component, names, *opened.snapshot);
    (has_all ? kept : lacking).push_back(component);
  }
  if (kept.empty()) std::swap(kept, lacking);
  for (const Component& component : lacking) {
    opened.notes.push_back(
        fmt::format("component {} is not drawn: its particles have no {}", component.name,
                    fmt::join(lacking_fields(component, names, *opened.snapshot), " and no ")));
  }
  for (Component& component : kept)
    component.select.where.push_back(condition);
  opened.scene.components = std::move(kept);
}

void color_by(const std::string& field, Component& component) {
  component.color = {field, scaling_of(field), {}, {}};
  component.color_vector.clear();
}

// Itself, or those of the formula that it is.
std::vector<std::string> fields_of(const std::string& field, const SceneWithSnapshot& opened) {
  const auto& components = opened.scene.components;
  const bool is_name =
      std::any_of(components.begin(), components.end(), [&](const Component& component) {
        return component.snapshot.empty() && have_fields(component, {field}, *opened.snapshot);
      });
  if (is_name || !Formula::may_be(field)) return {field};
  return Formula::parse(field, "field").fields();
}

// Components without the field stay as they are, unless none has it: then the first one's refusal
// says so.
void color_by(const ShortKeys& keys, SceneWithSnapshot& opened) {
  const std::vector<std::string> names = fields_of(keys.field, opened);
  bool is_there = false;
  for (Component& component : opened.scene.components) {
    const bool is_own = component.snapshot.empty();
    if (!is_own || !have_fields(component, names, *opened.snapshot)) continue;
    color_by(keys.field, component);
    is_there = true;
  }
  if (!is_there && !opened.scene.components.empty())
    color_by(keys.field, opened.scene.components.front());
}

// component.NAME.color.min=..., component.NAME.palette=...
bool is_of_colors(const std::string& setting) {
  const std::string key = trimmed(setting.substr(0, setting.find('=')));
  const bool is_of_component = key.rfind("component.", 0) == 0;
  return is_of_component &&
         (key.find(".color") != std::string::npos || key.find(".palette") != std::string::npos);
}

double read_width(const ShortKeys& keys, const SceneWithSnapshot& opened) {
  const double width = read_map_length(keys.width, opened.scene, *opened.snapshot, "width");
  if (width > 0) return width;
  throw UsageError(
      fmt::format("width: found \"{}\", expected a length above 0, such as 4Mpc", keys.width));
}

Vec3 find_center(const ShortKeys& keys, SceneWithSnapshot& opened) {
  if (keys.center.find(',') != std::string::npos)
    return read_place(keys.center, opened.scene, *opened.snapshot, "center");
  return find_named_place(keys.center, opened.scene, *opened.snapshot, "center", opened.notes);
}

// The camera comes nearer, or sees less where its distance does not count. It looks as it did.
void show_width(double width, const ImageSettings& image, Camera& camera) {
  using namespace boost::qvm;
  if (is_wide_angle(camera.projection)) {
    throw UsageError(
        "width: found it beside a projection of wide angles, which has no width; set "
        "camera.position");
  }
  if (camera.projection == Projection::orthographic || camera.width) {
    camera.field_of_view_degrees.reset();
    camera.width = width;
    return;
  }
  const CameraFrame frame = make_camera_frame(camera, image.width, image.height);
  const double shown = image.width / frame.pixels_per_length;
  camera.position = camera.look_at + (width / shown) * (camera.position - camera.look_at);
}

void place_camera(const ShortKeys& keys, SceneWithSnapshot& opened) {
  Scene& scene = opened.scene;
  if (!scene.camera) scene.camera = decide_camera(scene, *opened.snapshot);
  Camera& camera = *scene.camera;
  if (!keys.center.empty()) {
    const Vec3 center = find_center(keys, opened);
    camera.position += center - camera.look_at;
    camera.look_at = center;
  }
  if (!keys.width.empty()) show_width(read_width(keys, opened), scene.image, camera);
}

}  // namespace

ShortKeys take_short_keys(std::vector<std::string>& settings) {
  ShortKeys keys;
  std::vector<std::string> others;
  for (const std::string& setting : settings) {
    if (!take(trimmed(setting.substr(0, setting.find('='))), setting, keys))
      others.push_back(setting);
  }
  settings = std::move(others);
  return keys;
}

void keep_types(const ShortKeys& keys, Scene& scene) {
  if (keys.types.empty()) return;
  const std::string drawn = names_of_drawn(scene);
  for (Component& component : scene.components) {
    std::vector<int>& types = component.types;
    types.erase(std::remove_if(types.begin(), types.end(),
                               [&](int type) { return !is_wanted(keys, type); }),
                types.end());
  }
  auto& components = scene.components;
  components.erase(std::remove_if(components.begin(), components.end(),
                                  [](const Component& c) { return c.types.empty(); }),
                   components.end());
  if (!components.empty()) return;
  std::vector<std::string> names;
  for (const int type : keys.types)
    names.push_back(particle_type_name(type));
  throw UsageError(
      fmt::format("types: found {}, which no component of the scene draws, expected some of {}",
                  fmt::join(names, ", "), drawn));
}

Camera camera_for(const ImageSettings& image, Scene scene, const Snapshot& snapshot) {
  scene.camera.reset();
  scene.image = image;
  return decide_camera(scene, snapshot);
}

void choose_types(const ShortKeys& keys, const Snapshot& snapshot, Look look,
                  const ImageSettings& image, Scene& suggested) {
  if (keys.types.empty()) return;
  check_there_are(keys, snapshot);
  const std::vector<Component> all = suggested.components;
  std::vector<Component> chosen;
  for (const int type : keys.types) {
    const auto draws = [type](const Component& component) {
      return std::count(component.types.begin(), component.types.end(), type) > 0;
    };
    if (std::any_of(chosen.begin(), chosen.end(), draws)) continue;
    const auto found = std::find_if(all.begin(), all.end(), draws);
    if (found != all.end()) {
      chosen.push_back(*found);
      continue;
    }
    chosen.push_back(suggest_component(snapshot, {type}, look));
    chosen.back().name = particle_type_name(type);
  }
  suggested.components = std::move(chosen);
  keep_types(keys, suggested);
  suggested.camera = camera_for(image, suggested, snapshot);
}

void apply_colors(const ShortKeys& keys, const std::vector<std::string>& settings,
                  SceneWithSnapshot& opened) {
  if (keys.field.empty() && keys.palette.empty()) return;
  if (!keys.field.empty()) color_by(keys, opened);
  for (Component& component : opened.scene.components) {
    if (!keys.palette.empty()) component.palette = keys.palette;
  }
  std::vector<std::string> of_colors;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(of_colors), is_of_colors);
  opened.scene = apply_settings(opened.scene, of_colors);
}

void apply(const ShortKeys& keys, SceneWithSnapshot& opened) {
  for (const std::string& condition : keys.where)
    keep_where(condition, opened);
  if (!keys.center.empty() || !keys.width.empty()) place_camera(keys, opened);
}

}  // namespace splotchcl
