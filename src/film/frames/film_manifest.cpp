#include "film/frames/film_manifest.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <system_error>
#include <vector>

#include "scene_file/file_names.h"
#include "snapshot/snapshot_list.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

std::string describe(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  // The base name of several files.
  if (error) return file.string();
  const auto time = fs::last_write_time(file, error).time_since_epoch();
  return fmt::format("{}, {} bytes, time {}", fs::absolute(file, error).string(), size,
                     std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

class Inputs {
 public:
  void add_snapshots(const Scene& scene) {
    if (scene.time.is_set()) {
      for (const ListedSnapshot& snapshot : list_snapshots(scene.time))
        files_.insert(snapshot.path);
    } else {
      const auto snapshot = open_snapshot_for(scene.snapshot, scene.read);
      files_.insert(snapshot->info().files.begin(), snapshot->info().files.end());
    }
  }

  void add_named_files(Scene scene) {
    scene.path = {};  // its frames are told one by one
    scene_file::change_file_names(scene, [this](const std::string& name) {
      files_.insert(name);
      return name;
    });
    const std::string& other = scene.finish.cross_fade.scene;
    if (other.empty() || !others_.insert(other).second) return;
    const Scene fades_to = read_scene_file(other);
    add_snapshots(fades_to);
    add_named_files(fades_to);
  }

  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const fs::path& file : files_)
      lines.push_back(describe(file));
    return lines;
  }

 private:
  std::set<fs::path> files_;
  std::set<std::string> others_;
};

std::vector<std::string> inputs_of(const Scene& scene, const FilmPath& path) {
  Inputs inputs;
  inputs.add_snapshots(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame)
    inputs.add_named_files(path.scene_at(scene, frame));
  return inputs.lines();
}

}  // namespace

std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference) {
  std::string text =
      fmt::format("splotchcl {}, {}\n", SPLOTCHCL_VERSION, by_reference ? "reference" : "device");
  for (const std::string& input : inputs_of(scene, path))
    text += "input " + input + "\n";
  scene.movie = {};
  scene.path = {};
  text += format_scene(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame)
    text += fmt::format("frame {}: {}\n", frame, fmt::join(path.settings(frame), "; "));
  return text;
}

}  // namespace splotchcl
