#include "view/view_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "film/follow/find_followed.h"
#include "film/path/film_path.h"
#include "open_scene/input_files.h"
#include "scene_file/file_names.h"
#include "scene_file/suggested.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/camera.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::view {
namespace {

constexpr std::int64_t most_pixels = 8192 * 8192;

// The number that a key stands for, where it can be left open; null for all other keys.
std::optional<double>* find_open_number(Scene& scene, const std::string& key) {
  if (key == "finish.exposure") return &scene.finish.exposure;
  if (key == "finish.white") return &scene.finish.white;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const std::string start = fmt::format("component.{}.color.", i);
    if (key == start + "min") return &scene.components[i].color.minimum;
    if (key == start + "max") return &scene.components[i].color.maximum;
  }
  return nullptr;
}

std::vector<std::string> all_open_keys(const Scene& scene) {
  std::vector<std::string> keys = {"finish.exposure", "finish.white"};
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (scene.components[i].color.field.empty()) continue;
    keys.push_back(fmt::format("component.{}.color.min", i));
    keys.push_back(fmt::format("component.{}.color.max", i));
  }
  return keys;
}

bool is_known_palette(std::string name) {
  const std::vector<PaletteInfo> palettes = list_palettes();
  const auto has = [&palettes](const std::string& wanted) {
    return std::any_of(palettes.begin(), palettes.end(),
                       [&](const PaletteInfo& palette) { return palette.name == wanted; });
  };
  if (has(name)) return true;
  const bool is_reversed = name.size() > 2 && name.compare(name.size() - 2, 2, "_r") == 0;
  return is_reversed && has(name.substr(0, name.size() - 2));
}

// As keyframes have words: TOML or bare.
std::string unquoted(const std::string& word) {
  const bool is_quoted = word.size() >= 2 && word.front() == '"' && word.back() == '"';
  return is_quoted ? word.substr(1, word.size() - 2) : word;
}

bool is_palette_key(const std::string& key) {
  constexpr std::string_view end = "palette";
  return key.size() >= end.size() && key.compare(key.size() - end.size(), end.size(), end) == 0;
}

// All that a scene names, wherever it does: files, and palettes, which may be files.
std::set<std::string> names_in(const Scene& scene) {
  std::set<std::string> names;
  Scene copy = scene;
  scene_file::change_file_names(copy, [&names](const std::string& name) {
    names.insert(name);
    return name;
  });
  for (const Component& component : scene.components)
    names.insert({component.palette, component.absorption_palette});
  for (const Keyframe& keyframe : scene.path.keyframes) {
    for (const auto& [key, value] : keyframe.values) {
      if (is_palette_key(key)) names.insert(unquoted(value));
    }
  }
  return names;
}

// The one gate for names that come from a page: any that the opened scene has not itself may be a
// file, which the page has no business with.
void check_names(const Scene& opened, const Scene& scene) {
  const std::set<std::string> own = names_in(opened);
  for (const std::string& name : names_in(scene)) {
    if (own.count(name) > 0 || is_known_palette(name)) continue;
    throw UsageError("palette: found '" + name +
                     "', expected the scene's own or one that splotchcl palettes lists");
  }
}

bool sets(const PageState& state, const char* key) {
  return std::any_of(state.settings.begin(), state.settings.end(),
                     [key](const PageSetting& setting) { return setting.key == key; });
}

}  // namespace

Scene scene_of(const Scene& opened, const Scene* suggested, const PageState& state) {
  std::vector<std::string> settings;
  for (const PageSetting& setting : state.settings)
    settings.push_back(setting.key + "=" + setting.value);
  Scene scene = scene_file::apply_settings_to_suggested(opened, suggested, settings);
  for (const std::string& key : state.open) {
    std::optional<double>* const number = find_open_number(scene, key);
    if (number == nullptr) throw UsageError(key + ": found no value, expected one");
    number->reset();
  }
  if (state.keyframes) scene.path.keyframes = *state.keyframes;
  check_names(opened, scene);
  const std::int64_t pixels = std::int64_t{scene.image.width} * scene.image.height;
  if (pixels > most_pixels) {
    throw UsageError(fmt::format(
        "image.size: found {}x{} pixels, expected at most 8192x8192 in a page; save the scene and "
        "draw it with splotchcl render --size",
        scene.image.width, scene.image.height));
  }
  return scene;
}

GivenWay given_way(const Scene& opened, const PageState& state, const Scene& scene) {
  GivenWay instead;
  const Camera& camera = *scene.camera;
  const bool had_field_of_view = opened.camera->field_of_view_degrees.has_value();
  if (had_field_of_view && !camera.field_of_view_degrees && !camera.width) {
    instead.field_of_view_degrees = field_of_view_degrees(camera);
  }
  const std::array size = {scene.image.width, scene.image.height};
  const bool is_other = size != std::array{opened.image.width, opened.image.height};
  if (is_other && !sets(state, "image.size")) instead.size = size;
  return instead;
}

Scene without_hidden(Scene scene, const std::set<std::size_t>& hidden) {
  std::vector<Component> shown;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (hidden.count(i) == 0) shown.push_back(scene.components[i]);
  }
  if (shown.empty()) throw UsageError("all components are off, expected one to be drawn");
  scene.components = std::move(shown);
  return scene;
}

Scene at_frame(const Scene& scene, int frame) {
  std::vector<std::string> ignored;
  const FilmPath path(scene, ignored, find_followed);
  if (frame >= path.frame_count()) {
    throw UsageError(
        fmt::format("the film: found frame {}, expected one below {}", frame, path.frame_count()));
  }
  return path.scene_at(scene, frame);
}

std::set<std::string> open_keys(const Scene& scene) {
  Scene copy = scene;
  std::set<std::string> open;
  for (const std::string& key : all_open_keys(scene)) {
    if (!*find_open_number(copy, key)) open.insert(key);
  }
  return open;
}

std::map<std::string, double> numbers_of(const Scene& scene, const std::set<std::string>& keys) {
  Scene copy = scene;
  std::map<std::string, double> numbers;
  for (const std::string& key : keys) {
    const std::optional<double>* const number = find_open_number(copy, key);
    if (number != nullptr && *number) numbers[key] = **number;
  }
  return numbers;
}

namespace {

namespace fs = std::filesystem;

// The scene file that was opened is none of these: it is what most users want to replace.
std::set<fs::path> files_of(const ViewInputs& inputs) {
  InputFiles files;
  files.add(inputs.snapshot);
  for (const Scene* const scene : {&inputs.opened, &inputs.all}) {
    if (scene->time.is_set()) files.add_snapshots(*scene);
    files.add_named_files(*scene);
  }
  return files.all();
}

SaveResult check(const fs::path& path, bool may_replace, const ViewInputs& inputs) {
  check_outputs({{path, "the file to save"}}, [&] { return files_of(inputs); });
  std::error_code ignored;  // who writes it says what is wrong
  return fs::exists(path, ignored) && !may_replace ? SaveResult::exists : SaveResult::saved;
}

}  // namespace

std::string portable_scene_text(const Scene& scene) {
  Scene portable = scene;
  scene_file::change_file_names(portable, [](const std::string& name) {
    return fs::absolute(name).lexically_normal().string();
  });
  std::string& pattern = portable.time.pattern;
  if (!pattern.empty() && !fs::path(pattern).is_absolute()) {
    pattern = as_pattern((fs::current_path() / "").string()) + pattern;
  }
  return format_scene(portable);
}

SaveResult save_scene(const fs::path& path, bool may_replace, const Scene& scene,
                      const ViewInputs& inputs) {
  if (lower_ending(path) != ".toml") {
    throw UsageError(path.string() + ": found another ending, expected .toml for a scene");
  }
  if (check(path, may_replace, inputs) == SaveResult::exists) return SaveResult::exists;
  const std::string text = portable_scene_text(scene);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  return SaveResult::saved;
}

SaveResult check_picture(const fs::path& path, bool may_replace, const Scene& scene,
                         const ViewInputs& inputs) {
  check_image_path(path);
  check_image_size(path, scene.image.width, scene.image.height);
  return check(path, may_replace, inputs);
}

}  // namespace splotchcl::view
