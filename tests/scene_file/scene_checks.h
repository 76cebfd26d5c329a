#pragma once

#include "scene_file/keys.h"
#include "splotchcl/scene_file.h"
#include "testing.h"

namespace splotchcl::test {

inline bool same(const Vec3& a, const Vec3& b) {
  return a.a[0] == b.a[0] && a.a[1] == b.a[1] && a.a[2] == b.a[2];
}

// Key by key, so that a failure says which.
inline void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.camera.has_value(), b.camera.has_value());
  EXPECT_EQ(a.stereo.has_value(), b.stereo.has_value());
  ASSERT_EQ(a.components.size(), b.components.size());
  for (const scene_file::Key& key : scene_file::all_keys()) {
    const bool is_of_components = key.path.find("component.") == 0;
    for (std::size_t i = 0; i < (is_of_components ? a.components.size() : 1); ++i)
      EXPECT_EQ(key.get(a, i), key.get(b, i)) << key.path << " of component " << i;
  }
}

// A key's value as TOML, or "none"; of a component "component.0.palette".
inline std::string value_of(const Scene& scene, const std::string& path) {
  static const std::string of_components = "component.";
  std::string key = path;
  std::size_t component = 0;
  if (key.rfind(of_components, 0) == 0) {
    const std::size_t dot = key.find('.', of_components.size());
    component = std::stoul(key.substr(of_components.size(), dot));
    key.erase(of_components.size(), dot + 1 - of_components.size());
  }
  const bool is_there = key.rfind("camera.", 0) != 0 || scene.camera;
  const scene_file::Key* const found = scene_file::find_key(key);
  if (found == nullptr) return "no such key as " + key;
  return is_there ? found->get(scene, component).value_or("none") : "none";
}

// What a user is told about this text and these settings.
inline std::string message_for(const std::string& text,
                               const std::vector<std::string>& settings = {}) {
  return refusal_by<UsageError>([&] { parse_scene(text, "scene.toml", settings); });
}

}  // namespace splotchcl::test
