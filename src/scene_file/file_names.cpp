#include "scene_file/file_names.h"

#include <cstddef>
#include <map>
#include <optional>

#include "image/text.h"
#include "palette/palette_file.h"
#include "scene_file/keys.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"

namespace splotchcl::scene_file {
namespace {

bool is_any_name(const std::string& value) {
  return !value.empty();
}

// The keys, and which of their values are names of files.
const std::map<std::string, bool (*)(const std::string&)>& file_keys() {
  static const std::map<std::string, bool (*)(const std::string&)> keys = {
      {"snapshot", is_any_name},
      {"path.file", is_any_name},
      {"path.follow.catalog", is_any_name},
      {"movie.audio", is_any_name},
      {"image.background_image", is_any_name},
      {"finish.cross_fade.scene", is_any_name},
      {"finish.font", is_font_path},
      {"component.snapshot", is_any_name},
      {"component.select.ids", is_any_name},
      {"component.exclude.ids", is_any_name},
      {"component.select.catalog", is_any_name},
      {"component.exclude.catalog", is_any_name},
      {"component.palette", is_palette_path},
      {"component.absorption_palette", is_palette_path},
      {"map.palette", is_palette_path},
  };
  return keys;
}

void change_key(const Key& key, Scene& scene, std::size_t component, const ChangeName& change) {
  const std::optional<std::string> value = key.get(scene, component);
  if (!value) return;
  const std::string changed = with_file_name(key.path, *value, change);
  if (changed != *value) key.set(scene, component, *parse_value(changed).get("value"));
}

void change_keyframe(Keyframe& keyframe, const Scene& scene, const ChangeName& change) {
  for (auto& [key, value] : keyframe.values)
    value = with_file_name(locate(key, scene, "path.keyframes").path, value, change);
}

}  // namespace

std::string with_file_name(const std::string& path, const std::string& value,
                           const ChangeName& change) {
  const auto found = file_keys().find(path);
  if (found == file_keys().end()) return value;
  const auto name = parse_value(value)["value"].value_exact<std::string>();
  return name && found->second(*name) ? write_text(change(*name)) : value;
}

void change_file_names(Scene& scene, const ChangeName& change) {
  for (const auto& [path, is_name] : file_keys()) {
    const Key& key = *find_key(path);
    const bool is_of_component = path.rfind("component.", 0) == 0;
    const std::size_t count = is_of_component ? scene.components.size() : 1;
    for (std::size_t i = 0; i < count; ++i)
      change_key(key, scene, i, change);
  }
  for (std::string& snapshot : scene.time.snapshots)
    snapshot = change(snapshot);
  for (Keyframe& keyframe : scene.path.keyframes)
    change_keyframe(keyframe, scene, change);
}

}  // namespace splotchcl::scene_file
