#include "splotchcl/open_scene.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "common/words.h"
#include "formats/snapshot_format.h"
#include "load/passes.h"
#include "load/suggest_camera.h"
#include "open_scene/short_keys.h"
#include "open_scene/shown_snapshot.h"
#include "ranks/exchange.h"
#include "scene_file/suggested.h"
#include "sequence/snapshot_source.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {
namespace {

std::string key_of(const std::string& setting) {
  return trimmed(setting.substr(0, setting.find('=')));
}

// Which snapshot is drawn, when, and how it is read: it must be open before there is a scene to
// which all settings apply.
Scene begun_by(const Scene& start, const std::vector<std::string>& settings) {
  std::vector<std::string> own;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(own),
               [](const std::string& setting) {
                 const std::string key = key_of(setting);
                 return key.rfind("read.", 0) == 0 || key.rfind("time.", 0) == 0 ||
                        key.rfind("periodic.", 0) == 0;
               });
  return apply_settings(start, own);
}

Look look_in(const std::vector<std::string>& settings, Look otherwise) {
  std::vector<std::string> own;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(own),
               [](const std::string& setting) { return key_of(setting) == "look"; });
  return apply_settings(Scene(), own).look.value_or(otherwise);
}

// The picture for which a scene's camera is chosen. One that looks in all directions frames
// nothing.
ImageSettings framed_picture(const Scene& scene) {
  return is_wide_angle(scene.camera->projection) ? ImageSettings() : scene.image;
}

// That of a scene to which these settings will be applied.
ImageSettings framed_picture(const std::vector<std::string>& settings) {
  constexpr std::array<const char*, 6> keys = {"image.size",           "image.width",
                                               "image.height",         "camera.projection",
                                               "camera.field_of_view", "camera.width"};
  std::vector<std::string> own;
  for (const std::string& setting : settings) {
    if (std::count(keys.begin(), keys.end(), key_of(setting)) > 0) own.push_back(setting);
  }
  Scene begun;
  begun.camera.emplace();
  return framed_picture(scene_file::apply_settings_to_suggested(begun, &begun, own));
}

// A camera that settings left where it was chosen stands amid the matter where they make it look in
// all directions. Returns what counts as chosen from then on.
Camera look_all_around(Camera chosen, Camera& camera) {
  const bool is_moved = camera.position != chosen.position || camera.look_at != chosen.look_at ||
                        camera.through_clouds != chosen.through_clouds;
  if (is_moved || !is_wide_angle(camera.projection)) return chosen;
  stand_amid_matter(camera);
  chosen.position = camera.position;
  if (camera.through_clouds) return chosen;
  chosen.fade.near_length = camera.fade.near_length;
  chosen.through_clouds = false;
  return chosen;
}

// component.NAME.types=...
bool sets_types(const std::string& setting) {
  const std::string key = key_of(setting);
  const std::string ending = ".types";
  return key.rfind("component.", 0) == 0 && key.size() > ending.size() &&
         key.compare(key.size() - ending.size(), ending.size(), ending) == 0;
}

std::string names_of(const std::vector<int>& types, const std::string& between = ", ") {
  std::string names;
  for (const int type : types)
    names += (names.empty() ? "" : between) + particle_type_name(type);
  return names;
}

// A component still has the name of the types that it was suggested for, which would only confuse.
void check_wanted_types(const std::vector<int>& types, const std::string& key,
                        const Snapshot& snapshot) {
  std::vector<int> present;
  for (const ParticleTypeInfo& type : snapshot.info().types)
    present.push_back(type.type);
  const bool has_some = std::any_of(types.begin(), types.end(), [&snapshot](int type) {
    return snapshot.info().find_type(type) != nullptr;
  });
  if (has_some) return;
  throw UsageError("key " + key + ": found " + names_of(types) + ", of which " +
                   snapshot.info().files.front().string() + " has no particles, expected some of " +
                   names_of(present));
}

// As the settings have it: by the component's name or its number.
std::string key_of_types(std::size_t component, const std::string& name,
                         const std::vector<std::string>& settings) {
  const std::string by_name = "component." + name + ".types";
  const bool is_by_name =
      std::any_of(settings.begin(), settings.end(),
                  [&by_name](const std::string& setting) { return key_of(setting) == by_name; });
  return is_by_name ? by_name : "component." + std::to_string(component) + ".types";
}

// What was suggested for other types than a setting wants does not fit them: it is suggested anew,
// and so is the camera.
Scene with_wanted_types(Scene suggested, const std::vector<std::string>& settings,
                        const Snapshot& snapshot, Look look, const ImageSettings& image) {
  std::vector<std::string> own;
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(own), sets_types);
  if (own.empty()) return suggested;
  const Scene wanted = apply_settings(suggested, own);
  const bool are_suggested =
      std::equal(wanted.components.begin(), wanted.components.end(), suggested.components.begin(),
                 suggested.components.end(),
                 [](const Component& a, const Component& b) { return a.types == b.types; });
  if (are_suggested) return suggested;
  for (std::size_t i = 0; i < wanted.components.size(); ++i) {
    const std::vector<int>& types = wanted.components[i].types;
    if (types == suggested.components[i].types) continue;
    const std::string name = suggested.components[i].name;
    check_wanted_types(types, key_of_types(i, name, own), snapshot);
    suggested.components[i] = suggest_component(snapshot, types, look);
    suggested.components[i].name = name;
  }
  suggested.camera = camera_for(image, suggested, snapshot);
  return suggested;
}

// A component that was called by the types that it was suggested for is called by those that it has
// now, but where another one has that name.
void name_by_types(const Scene& suggested, Scene& scene) {
  const std::size_t count = std::min(scene.components.size(), suggested.components.size());
  for (std::size_t i = 0; i < count; ++i) {
    Component& component = scene.components[i];
    const bool is_called_so = component.name == suggested.components[i].name;
    if (!is_called_so || !find_particle_type(component.name)) continue;
    const bool is_right =
        std::any_of(component.types.begin(), component.types.end(),
                    [&component](int type) { return particle_type_name(type) == component.name; });
    const std::string name = names_of(component.types, " and ");
    const bool is_taken =
        std::any_of(scene.components.begin(), scene.components.end(),
                    [&name](const Component& other) { return other.name == name; });
    if (!is_right && !is_taken) component.name = name;
  }
}

// Most snapshots are binary: their first bytes hold some that no text does.
bool begins_like_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  // Some of the system's own claim to be empty, and keep their reader waiting.
  if (std::filesystem::file_size(path, error) == 0) return false;
  std::array<char, 256> start;
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  const auto length = file.gcount();
  return length > 0 && std::all_of(start.begin(), start.begin() + length, [](unsigned char c) {
           return c == '\n' || c == '\r' || c == '\t' || (c >= 32 && c != 127);
         });
}

// A scene file is such a text; a FITS file begins like one, too.
bool is_text_of_no_known_kind(const std::filesystem::path& path) {
  return begins_like_text(path) && find_format(path) == nullptr && find_other_kind(path) == nullptr;
}

// A scene file says its snapshot by a key, and so has a line with '=' that is no comment; a table
// that cannot be read, or prose, has none.
bool has_keys(const std::filesystem::path& path) {
  constexpr int most_lines = 1000;
  std::ifstream file(path);
  std::string line;
  for (int i = 0; i < most_lines && std::getline(file, line); ++i) {
    if (line.find('=') < line.find('#')) return true;
  }
  return false;
}

std::shared_ptr<const Snapshot> open_given_snapshot(const std::filesystem::path& path,
                                                    const ReadSettings& read) {
  try {
    return open_snapshot_for(path, read);
  } catch (const DataError& error) {
    if (!is_text_of_no_known_kind(path)) throw;
    throw DataError(std::string(error.what()) +
                    ", or a scene file, which has lines such as snapshot = \"snapshot_006\"");
  }
}

void check_components(const Scene& scene, const std::filesystem::path& path) {
  if (!scene.components.empty()) return;
  throw UsageError(
      path.string() +
      ": found no component, expected at least one; add a [[component]] with its types, "
      "such as types = \"gas\", or look = \"press\" to have them chosen");
}

// Beside components it would do nothing.
void refuse_look(const Scene& scene, const std::filesystem::path& path) {
  if (!scene.look) return;
  throw UsageError(
      path.string() +
      ": key look: found it beside components, expected one of the two: a look chooses "
      "components; delete the key, or every [[component]]");
}

// A scene file before its look has chosen anything: what it says of the camera comes on top of the
// one that is chosen, and need not say where it stands.
Scene read_before_its_look(const std::filesystem::path& path,
                           const std::vector<std::string>& settings) {
  Scene open;
  open.camera.emplace();
  return scene_file::read_scene_file_on(open, path, settings);
}

// A scene file without components leaves them to its look.
SceneWithSnapshot open_scene_file(const std::filesystem::path& path,
                                  const std::vector<std::string>& settings, const ShortKeys& keys,
                                  const std::shared_ptr<Communicator>& ranks) {
  std::vector<std::string> early;  // what does not presuppose components
  std::copy_if(settings.begin(), settings.end(), std::back_inserter(early),
               [](const std::string& setting) { return setting.rfind("component.", 0) != 0; });
  SceneWithSnapshot result;
  const Scene own = read_before_its_look(path, {});
  if (!own.components.empty() || !own.look) {
    result.scene = read_scene_file(path, settings);
    check_components(result.scene, path);
    refuse_look(result.scene, path);
    result.snapshot = SnapshotSource().at(result.scene);
    apply_colors(keys, settings, result);
    keep_types(keys, result.scene);
    return result;
  }
  const Scene begun = read_before_its_look(path, early);
  result.snapshot = SnapshotSource().at(begun);
  share_passes(*result.snapshot, ranks);
  const ImageSettings image = framed_picture(begun);
  Scene suggested = suggest_scene(*result.snapshot, *begun.look, image);
  choose_types(keys, *result.snapshot, *begun.look, image, suggested);
  suggested = with_wanted_types(suggested, settings, *result.snapshot, *begun.look, image);
  result.scene = scene_file::read_scene_file_on(suggested, path, settings);
  result.suggested_camera = look_all_around(*suggested.camera, *result.scene.camera);
  result.scene.look.reset();
  apply_colors(keys, settings, result);
  return result;
}

bool is_sequence(const std::filesystem::path& path) {
  std::error_code error;
  return is_snapshot_pattern(path.string()) && !std::filesystem::exists(path, error);
}

// The scene that is chosen from a snapshot's data, which may be a moment of a sequence.
SceneWithSnapshot suggest_for(const std::shared_ptr<const Snapshot>& snapshot,
                              const SequenceSettings& time,
                              const std::vector<std::string>& settings, const ShortKeys& keys,
                              Look otherwise) {
  SceneWithSnapshot result;
  result.snapshot = snapshot;
  const Look look = look_in(settings, otherwise);
  const ImageSettings image = framed_picture(settings);
  Scene suggested = suggest_scene(*snapshot, look, image);
  choose_types(keys, *snapshot, look, image, suggested);
  if (time.is_set()) suggested.snapshot.clear();
  suggested.time = time;
  result.suggested = with_wanted_types(suggested, settings, *snapshot, look, image);
  result.scene =
      scene_file::apply_settings_to_suggested(*result.suggested, &*result.suggested, settings);
  result.suggested->camera = look_all_around(*result.suggested->camera, *result.scene.camera);
  result.suggested_camera = result.suggested->camera;
  result.scene.look.reset();
  apply_colors(keys, settings, result);
  name_by_types(*result.suggested, result.scene);
  const std::string not_drawn = tell_not_drawn(result.scene, *snapshot);
  if (!not_drawn.empty() && keys.types.empty()) result.notes.push_back(not_drawn);
  return result;
}

// Of a sequence the last snapshot, in which there is most to be seen, unless the settings say when.
SceneWithSnapshot open_sequence(const std::string& pattern,
                                const std::vector<std::string>& settings, const ShortKeys& keys,
                                const std::shared_ptr<Communicator>& ranks, Look otherwise) {
  Scene start;
  start.time.pattern = pattern;
  Scene begun = begun_by(start, settings);
  if (!begun.time.index) begun.time.index = list_sequence(begun.time).back().index;
  const std::shared_ptr<const Snapshot> snapshot = SnapshotSource().at(begun);
  share_passes(*snapshot, ranks);
  return suggest_for(snapshot, begun.time, settings, keys, otherwise);
}

// Which one is drawn, so that all that asks the scene knows it.
void name_moment(SequenceSettings& time) {
  if (time.is_set() && !time.index) time.index = list_sequence(time).front().index;
}

SceneWithSnapshot open_together(const std::filesystem::path& path,
                                const std::vector<std::string>& settings, const ShortKeys& keys,
                                const std::shared_ptr<Communicator>& ranks, Look otherwise) {
  SceneWithSnapshot result;
  if (is_sequence(path)) {
    result = open_sequence(path.string(), settings, keys, ranks, otherwise);
  } else if (is_par_file(path)) {
    result.scene = read_par_file(path, settings, result.notes);
    refuse_look(result.scene, path);
    result.snapshot = SnapshotSource().at(result.scene);
    apply_colors(keys, settings, result);
    keep_types(keys, result.scene);
  } else if (lower_ending(path) == ".toml" || (is_text_of_no_known_kind(path) && has_keys(path))) {
    result = open_scene_file(path, settings, keys, ranks);
  } else {
    result.snapshot = open_given_snapshot(path, begun_by(Scene(), settings).read);
    share_passes(*result.snapshot, ranks);
    result = suggest_for(result.snapshot, {}, settings, keys, otherwise);
  }
  share_passes(*result.snapshot, ranks);
  name_moment(result.scene.time);
  apply(keys, result);
  return result;
}

}  // namespace

bool is_par_file(const std::filesystem::path& path) {
  return lower_ending(path) == ".par";
}

SceneWithSnapshot show_snapshot(const std::shared_ptr<const Snapshot>& snapshot,
                                const std::vector<std::string>& settings, Look look) {
  std::vector<std::string> of_keys = settings;
  const ShortKeys short_keys = take_short_keys(of_keys);
  SceneWithSnapshot result = suggest_for(snapshot, {}, of_keys, short_keys, look);
  apply(short_keys, result);
  return result;
}

SceneWithSnapshot show_scene(SceneWithSnapshot opened, const std::vector<std::string>& settings) {
  std::vector<std::string> of_keys = settings;
  const ShortKeys short_keys = take_short_keys(of_keys);
  const Scene* const suggested = opened.suggested ? &*opened.suggested : nullptr;
  opened.scene = scene_file::apply_settings_to_suggested(opened.scene, suggested, of_keys);
  keep_types(short_keys, opened.scene);
  apply_colors(short_keys, of_keys, opened);
  apply(short_keys, opened);
  return opened;
}

SceneWithSnapshot open_scene(const std::filesystem::path& path,
                             const std::vector<std::string>& settings,
                             const std::shared_ptr<Communicator>& ranks, Look look) {
  SceneWithSnapshot result;
  agree(ranks.get(), [&] {
    std::vector<std::string> of_keys = settings;
    const ShortKeys short_keys = take_short_keys(of_keys);
    result = open_together(path, of_keys, short_keys, ranks, look);
  });
  return result;
}

}  // namespace splotchcl
