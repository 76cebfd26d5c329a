#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/load/cached_snapshot.h"
#include "io/path/film_path.h"
#include "splotchcl/scene.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::cli {

// A scene with its path and its data, which are read once for all frames.
class FilmScene {
 public:
  // Checks every frame of the path. Reads no more than a scene without a camera needs for one.
  FilmScene(const std::filesystem::path& path, const std::vector<std::string>& settings);

  // Reads the first frame and decides from it whatever the scene leaves to the data.
  void decide();

  const Scene& scene() const { return scene_; }
  const FilmPath& path() const { return *path_; }
  Scene scene_at(int frame) const { return path_->scene_at(scene_, frame); }
  std::shared_ptr<const Snapshot> snapshot_at(const Scene& scene);
  // The data's files with size and time, a line each.
  std::vector<std::string> inputs();
  // What the user should know of scene, path and data.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void decide_camera();
  void check_moments() const;

  Scene scene_;
  SnapshotSource source_;
  // Of a scene with one snapshot; sequences remember by themselves.
  std::shared_ptr<const Snapshot> single_;
  std::shared_ptr<const CachedSnapshot> cached_;
  std::optional<FilmPath> path_;
  std::vector<std::string> notes_;
};

}  // namespace splotchcl::cli
