#include "splotchcl/scene_file.h"

#include <filesystem>
#include <string>
#include <vector>

#include "common/text_file.h"
#include "scene_file/builder.h"
#include "scene_file/file_names.h"
#include "scene_file/suggested.h"
#include "snapshot/snapshot_list.h"

namespace splotchcl {
namespace {

using scene_file::SceneBuilder;

std::string in_folder(const std::filesystem::path& folder, const std::string& pattern) {
  if (std::filesystem::path(pattern).is_absolute()) return pattern;
  return as_pattern((folder / "").string()) + pattern;
}

// What the file names stands relative to the file; what a setting names does not.
void resolve_paths(Scene& scene, const std::filesystem::path& folder) {
  scene_file::change_file_names(
      scene, [&folder](const std::string& name) { return (folder / name).string(); });
  if (!scene.time.pattern.empty()) scene.time.pattern = in_folder(folder, scene.time.pattern);
}

}  // namespace

Scene read_scene_file(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  SceneBuilder builder({}, path.string());
  builder.read_text(read_text_file(path));
  resolve_paths(builder.scene(), path.parent_path());
  builder.apply_settings(settings);
  const Scene scene = builder.finish();
  if (scene.snapshot.empty() && !scene.time.is_set()) {
    scene_file::refuse(path.string(), "snapshot", "nothing",
                       "the path of a snapshot, or time.snapshots");
  }
  return scene;
}

Scene parse_scene(const std::string& text, const std::string& name_for_messages,
                  const std::vector<std::string>& settings) {
  SceneBuilder builder({}, name_for_messages);
  builder.read_text(text);
  builder.apply_settings(settings);
  return builder.finish();
}

Scene apply_settings(const Scene& scene, const std::vector<std::string>& settings) {
  SceneBuilder builder(scene, "the scene");
  builder.apply_settings(settings);
  return builder.finish();
}

Scene scene_file::apply_settings_to_suggested(const Scene& scene, const Scene* suggested,
                                              const std::vector<std::string>& settings) {
  SceneBuilder builder(scene, "the scene");
  builder.apply_settings(settings, suggested);
  return builder.finish();
}

}  // namespace splotchcl
