#include "open_scene/input_files.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "common/file_identity.h"
#include "finish/finish_picture.h"
#include "ranks/exchange.h"
#include "scene_file/keys.h"
#include "sequence/snapshot_source.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/palette_file.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {

void InputFiles::add(const Snapshot& snapshot) {
  named_.insert(snapshot.info().files.begin(), snapshot.info().files.end());
  named_.insert(snapshot.info().files_beside.begin(), snapshot.info().files_beside.end());
}

void InputFiles::add_snapshots(const Scene& scene) {
  if (scene.time.is_set()) {
    for (const ListedSnapshot& snapshot : list_sequence(scene.time))
      add(path_in_file(snapshot.path).value_or(PathInFile{snapshot.path, ""}).file);
  } else {
    add(*open_snapshot_for(scene.snapshot, scene.read));
  }
}

void InputFiles::add_named_files(const Scene& scene) {
  Scene copy = scene;
  scene_file::change_file_names(copy, [this](const std::string& name) {
    named_.insert(name);
    return name;
  });
  add_palettes(scene);
  add_font(scene);
  const std::string& other = scene.finish.cross_fade.scene;
  if (other.empty() || !others_.insert(other).second) return;
  Scene fades_to = read_scene_file(other);
  fades_to.path = {};  // only its own films have frames
  add_snapshots(fades_to);
  add_named_files(fades_to);
}

void InputFiles::add_palettes(const Scene& scene) {
  const auto add_palette = [this](const std::string& name) {
    if (const auto file = own_palette_file(name); !file.empty()) add(file);
  };
  for (const Component& component : scene.components) {
    add_palette(component.palette);
    add_palette(component.absorption_palette);
  }
  add_palette(scene.map.palette);
}

void InputFiles::add_font(const Scene& scene) {
  std::optional<std::filesystem::path>& known = fonts_[scene.finish.font];
  if (!known) known = font_file(scene.finish);
  if (known) add(*known);
}

std::set<std::filesystem::path> InputFiles::with_sets() const {
  std::set<std::filesystem::path> files = named_;
  ExistingFiles existing;
  std::error_code ignored;
  for (const std::filesystem::path& name : named_) {
    const auto of_set = existing.files_of(name);
    files.insert(of_set.begin(), of_set.end());
    if (std::filesystem::is_directory(name, ignored)) {
      const std::unique_ptr<Snapshot> in_folder = open_snapshot(name);
      const std::vector<std::filesystem::path>& members = in_folder->info().files;
      files.insert(members.begin(), members.end());
    }
  }
  return files;
}

std::set<std::filesystem::path> InputFiles::all() const {
  std::set<std::filesystem::path> files = with_sets();
  for (const PaletteInfo& palette : list_palettes()) {
    if (!palette.file.empty()) files.insert(palette.file);
  }
  return files;
}

std::set<std::filesystem::path> files_read(const std::filesystem::path& file, const Scene& scene,
                                           const Snapshot& snapshot) {
  InputFiles inputs;
  inputs.add(file);
  inputs.add(snapshot);
  if (scene.time.is_set()) inputs.add_snapshots(scene);
  inputs.add_named_files(scene);
  return inputs.all();
}

WatchedFiles watched_files(const Scene& scene, const Snapshot& snapshot) {
  WatchedFiles watched;
  for (const std::filesystem::path& file : snapshot.info().files)
    watched.add(file);
  for (const std::filesystem::path& file : snapshot.info().files_beside)
    watched.add(file);
  Scene copy = scene;
  scene_file::change_file_names(copy, [&watched](const std::string& name) {
    watched.add(name);
    return name;
  });
  return watched;
}

void require_same_files(Communicator& ranks, const std::set<std::filesystem::path>& files,
                        ContentMarks& marks) {
  const std::string advice = "give all processes the same files";
  require_same(ranks, "a number of files to read of", std::to_string(files.size()), advice);
  for (const std::filesystem::path& file : files) {
    const std::optional<FileIdentity> found = file_identity(file);
    const std::string content =
        found ? fmt::format("{} bytes (mark {:016x})", found->bytes, marks.of(file)) : "none";
    require_same(ranks, "in " + file.string(), content, advice);
  }
}

}  // namespace splotchcl
