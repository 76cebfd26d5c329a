#include "splotchcl/scene_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/mapped_file.h"
#include "scene_file/builder.h"
#include "scene_file/check.h"
#include "scene_file/keys.h"
#include "scene_file/suggested.h"
#include "snapshot/snapshot_files.h"

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

Scene read_file(SceneBuilder builder, const std::filesystem::path& path,
                const std::vector<std::string>& settings, const Scene* suggested) {
  builder.read_text(read_text_file(path), suggested);
  resolve_paths(builder.scene(), path.parent_path());
  builder.apply_settings(settings, suggested);
  Scene scene = builder.finish();
  if (scene.snapshot.empty() && !scene.time.is_set()) {
    scene_file::refuse(path.string(), "snapshot", "nothing",
                       "the path of a snapshot, or time.snapshots");
  }
  return scene;
}

}  // namespace

Scene read_scene_file(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  return read_file(SceneBuilder({}, path.string()), path, settings, nullptr);
}

Scene scene_file::read_scene_file_on(const Scene& suggested, const std::filesystem::path& path,
                                     const std::vector<std::string>& settings) {
  Scene open = suggested;
  open.snapshot.clear();  // the file names it
  return read_file(SceneBuilder(open, path.string()), path, settings, &open);
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

namespace {

using scene_file::Key;

// "a.b.c" -> {"a", "b.c"}, "c" -> {"", "c"}
std::pair<std::string, std::string> split_first(const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {"", path};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

// The lines of one table. Keys of an inner table (size.field, size.factor) follow each
// other in the list of keys, and share a line.
std::string format_table(const std::string& table, const Scene& scene, std::size_t component) {
  std::vector<std::string> lines;
  std::string open_group;
  Scene plain;
  plain.camera.emplace();
  for (const Key& key : scene_file::all_keys()) {
    const auto [key_table, rest] = split_first(key.path);
    if (key_table != table || !key.is_written) continue;
    const std::optional<std::string> value = key.get(scene, component);
    if (!value || (!key.is_written_by_default && value == key.get(plain, 0))) continue;
    const auto [group, name] = split_first(rest);
    const std::string entry = fmt::format("{} = {}", name, *value);
    if (group.empty()) {
      lines.push_back(entry);
    } else if (group == open_group) {
      lines.back().replace(lines.back().size() - 2, 2, ", " + entry + " }");
    } else {
      lines.push_back(fmt::format("{} = {{ {} }}", group, entry));
    }
    open_group = group;
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace

std::string format_scene(const Scene& scene) {
  // A scene made by hand may hold what no scene file can say.
  const std::string name = "the scene to write";
  scene_file::check_scene(scene, {name, {}});
  std::string text = format_table("", scene, 0);
  for (const std::string table : {"read", "image", "camera", "stereo", "kernel", "sort", "time",
                                  "path", "movie", "periodic", "finish", "map"}) {
    if (table == "camera" && !scene.camera) continue;
    if (table == "stereo" && !scene.stereo) continue;
    const std::string lines = format_table(table, scene, 0);
    // Tables that most scenes do not have.
    const bool is_for_some =
        table == "read" || table == "time" || table == "path" || table == "movie";
    if (lines == "\n") continue;
    if (is_for_some && lines == format_table(table, {}, 0)) continue;
    text += fmt::format("\n[{}]\n{}", table, lines);
  }
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    text += fmt::format("\n[[component]]\n{}", format_table("component", scene, i));
  }
  parse_scene(text, name);
  return text;
}

}  // namespace splotchcl
