#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "common/words.h"
#include "film/path/path_table.h"
#include "scene_file/keys.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using scene_file::find_key;
using scene_file::one_line;

// The original program's names for what does not depend on a component.
const std::map<std::string, std::string>& original_names() {
  static const std::map<std::string, std::string> names = {
      {"camera_x", "camera.position.x"},
      {"camera_y", "camera.position.y"},
      {"camera_z", "camera.position.z"},
      {"lookat_x", "camera.look_at.x"},
      {"lookat_y", "camera.look_at.y"},
      {"lookat_z", "camera.look_at.z"},
      {"sky_x", "camera.sky.x"},
      {"sky_y", "camera.sky.y"},
      {"sky_z", "camera.sky.z"},
      {"fov", "camera.field_of_view"},
      {"zmin", "camera.near"},
      {"zmax", "camera.far"},
      {"minrad_pix", "kernel.min_radius"},
      {"fidx", "time.index"},
  };
  return names;
}

// Those that end with a component's number.
const std::map<std::string, std::string>& original_component_names() {
  static const std::map<std::string, std::string> names = {
      {"brightness", "brightness"},       {"size_fac", "size.factor"},
      {"size_fix", "size.fixed"},         {"color_min", "color.min"},
      {"color_max", "color.max"},         {"intensity_min", "intensity.min"},
      {"intensity_max", "intensity.max"}, {"palette", "palette"},
  };
  return names;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// "brightness0" is component.0.brightness. Other names are left as they are.
std::string without_original_names(const std::string& name) {
  const auto plain = original_names().find(name);
  if (plain != original_names().end()) return plain->second;
  const auto digits = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  const auto found = original_component_names().find(std::string(name.begin(), digits));
  if (digits == name.end() || found == original_component_names().end()) return name;
  return "component." + std::string(digits, name.end()) + "." + found->second;
}

std::optional<std::size_t> axis_of(const std::string& word) {
  constexpr std::array<std::array<const char*, 3>, 4> words = {
      {{"x", "y", "z"}, {"0", "1", "2"}, {"r", "g", "b"}, {"red", "green", "blue"}}};
  for (const auto& three : words) {
    const auto found = std::find(three.begin(), three.end(), word);
    if (found != three.end()) return static_cast<std::size_t>(found - three.begin());
  }
  return std::nullopt;
}

// The key's address, if it is one.
std::optional<scene_file::KeyAddress> find_address(const std::string& key, const Scene& scene,
                                                   const std::string& where) {
  const scene_file::KeyAddress address = scene_file::locate(key, scene, where);
  return find_key(address.path) == nullptr ? std::nullopt : std::optional(address);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const scene_file::Key& key : scene_file::all_keys()) {
    if (may_change_in_film(key.path)) names.push_back(key.path);
  }
  for (const auto& [name, key] : original_names())
    names.push_back(name);
  return names;
}

std::string list_names(const std::map<std::string, std::string>& names) {
  std::string list;
  for (const auto& [name, key] : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

[[noreturn]] void refuse_column(const std::string& name, const std::string& where) {
  throw UsageError(fmt::format(
      "{}: found {}, expected a key of a scene file such as camera.field_of_view, a part of one "
      "such as camera.position.x, one of the original program's {}, or with a component's number "
      "one of {}{}",
      where, scene_file::write_text(one_line(name)), list_names(original_names()),
      list_names(original_component_names()), did_you_mean(nearest_name(name, all_names()))));
}

std::optional<Scaling> scaling_to_undo(const scene_file::KeyAddress& address, const Scene& scene) {
  const bool is_color = address.path.rfind("component.color.", 0) == 0;
  const Component& component = scene.components.at(address.component);
  return (is_color ? component.color : component.intensity).scaling;
}

}  // namespace

bool may_change_in_film(const std::string& path) {
  const std::string table = path.substr(0, path.find('.'));
  return table != "path" && table != "movie" && table != "map" && table != "read" &&
         path != "image.size" && path != "image.width" && path != "image.height" &&
         path != "component.name";
}

void check_may_change(const std::string& path, const std::string& name, const std::string& where) {
  if (may_change_in_film(path)) return;
  const bool is_of_reading = path.rfind("read.", 0) == 0;
  throw UsageError(fmt::format(
      "{}: found {}, expected keys that may change within a film{}", where, one_line(name),
      is_of_reading ? "; its data is read once: set the key for the whole film" : ""));
}

PathColumn find_path_column(const std::string& name, const Scene& scene, const std::string& where) {
  const std::string key = without_original_names(name);
  PathColumn column;
  column.name = name;
  column.key = key;
  std::optional<scene_file::KeyAddress> address = find_address(key, scene, where);
  if (!address) {
    const std::size_t dot = key.rfind('.');
    column.axis = dot == std::string::npos ? std::nullopt : axis_of(key.substr(dot + 1));
    if (column.axis) {
      column.key = key.substr(0, dot);
      address = find_address(column.key, scene, where);
    }
  }
  if (!address) refuse_column(name, where);
  check_may_change(address->path, name, where);
  column.path = address->path;
  column.label = address->label;
  // The original's is of r = 2 h.
  if (name == "minrad_pix") column.factor = 0.5;
  const std::string last = address->path.substr(address->path.rfind('.') + 1);
  const bool is_range = last == "min" || last == "max";
  if (key != name && is_range) column.undo = scaling_to_undo(*address, scene);
  return column;
}

}  // namespace splotchcl
