#include "cli/film_scene.h"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "cli/scene_argument.h"
#include "io/sequence/snapshot_list.h"
#include "splotchcl/error.h"

namespace splotchcl::cli {
namespace {

std::string describe(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  // The base name of several files.
  if (error) return file.string();
  const auto time = std::filesystem::last_write_time(file, error).time_since_epoch();
  return fmt::format("{}, {} bytes, time {}", std::filesystem::absolute(file, error).string(), size,
                     std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

}  // namespace

FilmScene::FilmScene(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  SceneWithSnapshot opened = open_scene(path, settings);
  scene_ = std::move(opened.scene);
  notes_ = std::move(opened.notes);
  if (!scene_.camera && !path_has_camera(scene_)) decide_camera();
  path_.emplace(scene_, notes_);
  path_->check(scene_);
  check_moments();
}

// Every frame lies within the sequence.
void FilmScene::check_moments() const {
  if (!scene_.time.is_set()) return;
  const std::vector<ListedSnapshot> list = list_snapshots(scene_.time);
  for (int frame = 0; frame < path_->frame_count(); ++frame) {
    try {
      find_place(list, scene_at(frame).time.index);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("frame {} of the path: {}", frame, error.what()));
    }
  }
}

void FilmScene::decide_camera() {
  std::vector<std::string> ignored;  // load_frame tells it again
  scene_.camera = decide_scene(scene_, load_frame(scene_, *snapshot_at(scene_), ignored)).camera;
}

void FilmScene::decide() {
  const Scene first = scene_at(0);
  source_.check(first);
  const std::shared_ptr<const Snapshot> snapshot = snapshot_at(first);
  notes_.insert(notes_.end(), snapshot->info().notes.begin(), snapshot->info().notes.end());
  scene_ = decide_scene(first, load_frame(first, *snapshot, notes_));
}

std::shared_ptr<const Snapshot> FilmScene::snapshot_at(const Scene& scene) {
  std::shared_ptr<const Snapshot> snapshot = source_.at(scene);
  if (scene.time.is_set()) return snapshot;
  if (single_ != snapshot) {
    single_ = snapshot;
    cached_ = std::make_shared<CachedSnapshot>(snapshot);
  }
  return cached_;
}

std::vector<std::string> FilmScene::inputs() {
  std::vector<std::string> files;
  if (scene_.time.is_set()) {
    for (const ListedSnapshot& snapshot : list_snapshots(scene_.time))
      files.push_back(describe(snapshot.path));
  } else {
    for (const std::filesystem::path& file : snapshot_at(scene_)->info().files)
      files.push_back(describe(file));
  }
  for (const Component& component : scene_.components) {
    if (!component.snapshot.empty()) files.push_back(describe(component.snapshot));
  }
  return files;
}

}  // namespace splotchcl::cli
