#include "view/view_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "film/follow/followed_particles.h"
#include "film/movie/encoder.h"
#include "open_scene/input_files.h"
#include "scene_file/keys.h"
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

// "component.12.palette" -> "12", "palette"; empty where it is none of a component.
std::pair<std::string, std::string> parts_of_component_key(const std::string& key) {
  constexpr std::string_view start = "component.";
  if (key.rfind(start, 0) != 0) return {};
  const std::size_t dot = key.find('.', start.size());
  if (dot == std::string::npos) return {};
  return {key.substr(start.size(), dot - start.size()), key.substr(dot + 1)};
}

void clear_sphere(ParticleSet& set) {
  set.sphere_center.reset();
  set.sphere_radius.reset();
  set.sphere_rim.reset();
}

// False: the component must have it.
bool leave_to_default(Component& component, const std::string& key) {
  using Clear = void (*)(Component&);
  static const std::map<std::string, Clear> clear = {
      {"absorption", [](Component&) {}},  // another rule, which the page does not set
      {"weight", [](Component& c) { c.weight.reset(); }},
      {"color.field", [](Component& c) { c.color.field.clear(); }},
      {"color.scaling", [](Component&) {}},
      {"intensity.field", [](Component& c) { c.intensity.field.clear(); }},
      {"intensity.scaling", [](Component&) {}},
      {"intensity.min", [](Component& c) { c.intensity.minimum.reset(); }},
      {"intensity.max", [](Component& c) { c.intensity.maximum.reset(); }},
      {"select.where", [](Component& c) { c.select.where.clear(); }},
      {"select.sphere.center", [](Component& c) { clear_sphere(c.select); }},
      {"select.sphere.radius", [](Component& c) { clear_sphere(c.select); }},
      {"select.box.min", [](Component& c) { c.select.box_minimum.reset(); }},
      {"select.box.max", [](Component& c) { c.select.box_maximum.reset(); }},
  };
  const auto found = clear.find(key);
  if (found == clear.end()) return false;
  found->second(component);
  return true;
}

// False: the scene must have it.
bool leave_to_default(Scene& scene, const std::string& key) {
  if (key == "finish.title.text") {
    scene.finish.title.text.clear();
  } else if (key == "finish.caption.text") {
    scene.finish.caption.text.clear();
  } else if (key == "finish.white_balance") {
    scene.finish.white_balance.reset();
  } else if (key == "stereo.layout" || key == "stereo.angle") {
    scene.stereo.reset();
  } else {
    const std::optional<std::size_t> component = component_of_key(scene, key);
    return component &&
           leave_to_default(scene.components[*component], parts_of_component_key(key).second);
  }
  return true;
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

bool has_component(const Scene& scene, const std::string& name) {
  return std::any_of(scene.components.begin(), scene.components.end(),
                     [&name](const Component& component) { return component.name == name; });
}

bool sets(const PageState& state, const char* key) {
  return std::any_of(state.settings.begin(), state.settings.end(),
                     [key](const PageSetting& setting) { return setting.key == key; });
}

bool moves_camera(const Keyframe& keyframe) {
  return std::any_of(keyframe.values.begin(), keyframe.values.end(),
                     [](const auto& value) { return value.first.rfind("camera.", 0) == 0; });
}

// The film is as long as these say. They take the place of another path where both would move the
// camera.
void set_keyframes(Scene& scene, const std::vector<Keyframe>& keyframes) {
  if (std::any_of(keyframes.begin(), keyframes.end(), moves_camera)) {
    PathSettings own;
    own.is_smooth = scene.path.is_smooth;
    own.look = scene.path.look;
    own.max_turn_rate = scene.path.max_turn_rate;
    scene.path = own;
  }
  scene.path.keyframes = keyframes;
  scene.movie.frames.reset();
}

}  // namespace

Scene with_components(Scene scene, const std::vector<Component>& added) {
  for (const Component& component : added) {
    std::string name = component.name;
    for (int i = 2; has_component(scene, name); ++i)
      name = fmt::format("{} {}", component.name, i);
    scene.components.push_back(component);
    scene.components.back().name = name;
  }
  return scene;
}

Scene scene_of(const Scene& opened, const Scene* suggested, const PageState& state) {
  std::vector<std::string> settings;
  for (const PageSetting& setting : state.settings)
    settings.push_back(setting.key + "=" + setting.value);
  Scene scene = scene_file::apply_settings_to_suggested(opened, suggested, settings);
  for (const std::string& key : state.open) {
    if (std::optional<double>* const number = find_open_number(scene, key)) {
      number->reset();
    } else if (!leave_to_default(scene, key)) {
      throw UsageError(key + ": found no value, expected one");
    }
  }
  if (state.keyframes) set_keyframes(scene, *state.keyframes);
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

std::optional<std::size_t> component_of_key(const Scene& scene, const std::string& key) {
  const std::string word = parts_of_component_key(key).first;
  if (word.empty()) return std::nullopt;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (word == scene.components[i].name || word == std::to_string(i)) return i;
  }
  return std::nullopt;
}

namespace {

// By their new numbers, the keys that are of components that are shown, and all others.
std::map<std::string, std::string> shown_values(const Scene& scene, const Keyframe& keyframe,
                                                const std::set<std::size_t>& hidden) {
  std::map<std::string, std::string> values;
  for (const auto& [key, value] : keyframe.values) {
    const std::optional<std::size_t> component = component_of_key(scene, key);
    if (!component) {
      values[key] = value;
    } else if (hidden.count(*component) == 0) {
      const auto before =
          static_cast<std::size_t>(std::distance(hidden.begin(), hidden.lower_bound(*component)));
      values[fmt::format("component.{}.{}", *component - before,
                         parts_of_component_key(key).second)] = value;
    }
  }
  return values;
}

}  // namespace

Scene without_hidden(Scene scene, const std::set<std::size_t>& hidden) {
  if (hidden.empty()) return scene;
  std::vector<Keyframe> keyframes;
  for (Keyframe keyframe : scene.path.keyframes) {
    keyframe.values = shown_values(scene, keyframe, hidden);
    if (!keyframe.values.empty()) keyframes.push_back(std::move(keyframe));
  }
  scene.path.keyframes = std::move(keyframes);
  std::vector<Component> shown;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    if (hidden.count(i) == 0) shown.push_back(scene.components[i]);
  }
  if (shown.empty()) throw UsageError("all components are off, expected one to be drawn");
  scene.components = std::move(shown);
  return scene;
}

FilmPath film_of(const Scene& scene) {
  std::vector<std::string> ignored;
  return FilmPath(scene, ignored, find_followed);
}

Scene at_frame(const FilmPath& film, const Scene& scene, int frame) {
  if (frame >= film.frame_count()) {
    throw UsageError(
        fmt::format("the film: found frame {}, expected one below {}", frame, film.frame_count()));
  }
  return film.scene_at(scene, frame);
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

SaveResult check_film_file(const fs::path& path, bool may_replace, const ViewInputs& inputs) {
  if (!is_film_path(path)) {
    throw UsageError(path.string() +
                     ": found another ending, expected .mp4, .mov, .mkv or .webm for a film");
  }
  return check(path, may_replace, inputs);
}

}  // namespace splotchcl::view
