#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/file_identity.h"
#include "film/path/film_path.h"
#include "open_scene/input_files.h"
#include "pictures/other_scenes.h"
#include "sequence/snapshot_source.h"
#include "splotchcl/communicator.h"
#include "splotchcl/film.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The files that the frames are drawn from, but for those of the path.
InputFiles film_inputs(const Scene& scene, const FilmPath& path);

// All that drawing the film of a scene from a file reads: InputFiles::all() of both.
std::set<std::filesystem::path> film_files_read(const std::filesystem::path& file,
                                                const Scene& scene, const FilmPath& path);

// All that the frames of a film depend on, but for the device, which gives the same within the
// tolerance: the scene as it was decided, what each frame sets, and the files of data, palettes,
// lists, pictures and fonts, also those of scenes that it fades to, with their size, their time and
// what they hold.
std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference,
                          ContentMarks& marks);

// A scene with its path and its data, which are read once for all frames.
class FilmScene {
 public:
  // Checks every frame of the path. Reads particles only to choose a camera for a scene that has
  // none. All of `ranks`, where there are some, make the same calls, within agree().
  // `target` is as in FilmOptions.
  FilmScene(const std::filesystem::path& path, const std::vector<std::string>& settings,
            const std::shared_ptr<Communicator>& ranks = nullptr, const FilmTarget& target = {});

  // First checks what frames name: fields, palettes, files, texts. Then decides whatever the scene
  // leaves to the data, from the first frame, or from a later one for a component of which the
  // first shows nothing.
  void decide();

  const Scene& scene() const { return scene_; }
  const FilmPath& path() const { return *path_; }
  Scene scene_at(int frame) const { return path_->scene_at(scene_, frame); }
  std::vector<Scene> blurred_scenes(int frame) const {
    return path_->blurred_scenes(scene_, frame);
  }
  std::shared_ptr<const Snapshot> snapshot_at(const Scene& scene);
  OtherScenes& other_scenes() { return other_scenes_; }
  // Throws DataError where a file that frames are drawn from is no longer what it was when the
  // scene was opened.
  void check_files() const { files_.check(); }
  // What the user should know of scene, path and data.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void watch_files();
  void check_moments() const;
  void check_words();
  void decide_components();

  std::shared_ptr<Communicator> ranks_;  // null: this process alone
  Scene scene_;
  WatchedFiles files_;
  FilmSnapshots snapshots_;
  OtherScenes other_scenes_;
  std::optional<FilmPath> path_;
  std::vector<std::string> notes_;
};

}  // namespace splotchcl
