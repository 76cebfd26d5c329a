#include "film/frames/film_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include "common/file_identity.h"
#include "film/follow/find_followed.h"
#include "film/frames/suggest_film.h"
#include "film/path/simplify_path.h"
#include "load/passes.h"
#include "sequence/list_sequence.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, ContentMarks& marks) {
  const std::optional<FileIdentity> found = file_identity(file);
  // A base name, whose files have lines of their own.
  if (!found) return file.string();
  std::error_code error;
  return fmt::format("{}, {}, holds {:016x}", fs::absolute(file, error).string(), describe(found),
                     marks.of(file));
}

std::vector<std::string> lines_of(const InputFiles& inputs, ContentMarks& marks) {
  std::vector<std::string> lines;
  for (const fs::path& file : inputs.with_sets())
    lines.push_back(line_of(file, marks));
  return lines;
}

}  // namespace

InputFiles film_inputs(const Scene& scene, const FilmPath& path) {
  InputFiles inputs;
  inputs.add_snapshots(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame) {
    Scene shown = path.scene_at(scene, frame);
    shown.path = {};            // its frames are told one by one
    shown.movie.audio.clear();  // no frame depends on it
    inputs.add_named_files(shown);
  }
  return inputs;
}

std::set<fs::path> film_files_read(const fs::path& file, const Scene& scene, const FilmPath& path) {
  InputFiles inputs = film_inputs(scene, path);
  inputs.add(file);
  inputs.add_named_files(scene);
  return inputs.all();
}

std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference,
                          ContentMarks& marks) {
  std::string text =
      fmt::format("splotchcl {}, {}\n", SPLOTCHCL_VERSION, by_reference ? "reference" : "device");
  for (const std::string& input : lines_of(film_inputs(scene, path), marks))
    text += "input " + input + "\n";
  const std::optional<MotionBlur> blur = scene.movie.motion_blur;
  scene.movie = {};
  scene.movie.motion_blur = blur;
  scene.path = {};
  text += format_scene(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame)
    text += fmt::format("frame {}: {}\n", frame, fmt::join(path.settings(frame), "; "));
  return text;
}

namespace {

// Whether the value of "key=value" is a word, such as a field's name, or holds one.
bool has_words(const std::string& setting) {
  const std::string value = setting.substr(setting.find('=') + 1);
  return value.find_first_not_of("0123456789+-.eE[], ") != std::string::npos;
}

// With the picture's own upward direction as its sky, about which an orbit turns that has no axis:
// what the camera was chosen to show stays in the middle, as high as it is.
Camera upright(Camera camera, const ImageSettings& image) {
  using namespace boost::qvm;
  camera.sky = -make_camera_frame(camera, image.width, image.height).down;
  return camera;
}

// What is left of a camera that was suggested.
struct SuggestedView {
  bool place = false;  // where it is, and what it looks at
  bool zoom = false;
};

SuggestedView suggested_view(const SceneWithSnapshot& opened) {
  if (!opened.suggested || !opened.suggested->camera || !opened.scene.camera) return {};
  const Camera &now = *opened.scene.camera, &suggested = *opened.suggested->camera;
  SuggestedView left;
  left.place = now.position == suggested.position && now.look_at == suggested.look_at &&
               now.through_clouds == suggested.through_clouds;
  left.zoom = now.field_of_view_degrees == suggested.field_of_view_degrees &&
              now.projection == suggested.projection;
  return left;
}

}  // namespace

FilmScene::FilmScene(const std::filesystem::path& path, const std::vector<std::string>& settings,
                     const std::shared_ptr<Communicator>& ranks, const FilmTarget& target)
    : ranks_(ranks) {
  WatchedFiles opening;  // a scene file may change later on: it is read only once
  opening.add(path);
  SceneWithSnapshot opened = open_scene(path, settings, ranks);
  const SuggestedView view = suggested_view(opened);
  scene_ = std::move(opened.scene);
  notes_ = std::move(opened.notes);
  watch_files();
  opening.check();
  if (!scene_.camera && !path_has_camera(scene_)) {
    scene_.camera = upright(decide_camera(scene_, *snapshot_at(scene_)), scene_.image);
  }
  if (view.place && view.zoom && scene_.time.is_set() && !target.is_approached)
    show_whole_course(scene_);
  if (view.place) stand_amid_matter(*scene_.camera, !target.name.empty());
  // A scene file that says how long its film is says what it is, too.
  if (opened.suggested || !target.name.empty() || !scene_.movie.frames) {
    const std::string note = suggest_film(target, *snapshot_at(scene_), scene_);
    if (!note.empty()) notes_.push_back(note);
  }
  scene_ = with_simple_path(std::move(scene_), notes_);
  path_.emplace(scene_, notes_, find_followed);
  path_->check(scene_);
  watch_files();
  check_moments();
}

// Those that are known before the path is read, then those of its frames.
void FilmScene::watch_files() {
  InputFiles inputs;
  if (path_) {
    inputs = film_inputs(scene_, *path_);
  } else {
    inputs.add_snapshots(scene_);
    inputs.add_named_files(scene_);
  }
  for (const std::filesystem::path& file : inputs.with_sets())
    files_.add(file);
}

std::shared_ptr<const Snapshot> FilmScene::snapshot_at(const Scene& scene) {
  auto snapshot = snapshots_.at(scene);
  share_passes(*snapshot, ranks_);
  return snapshot;
}

// Every frame lies within the sequence.
void FilmScene::check_moments() const {
  if (!scene_.time.is_set()) return;
  const std::vector<ListedSnapshot> list = list_sequence(scene_.time);
  for (int frame = 0; frame < path_->frame_count(); ++frame) {
    try {
      find_place(list, scene_at(frame).time.index);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("frame {} of the path: {}", frame, error.what()));
    }
  }
}

void FilmScene::decide() {
  const Scene first = scene_at(0);
  snapshots_.check(first);
  check_words();
  const std::vector<std::string>& of_data = snapshot_at(first)->info().notes;
  notes_.insert(notes_.end(), of_data.begin(), of_data.end());
  decide_components();
  for (int frame = 0; frame < path_->frame_count(); ++frame)
    other_scenes_.decide(scene_at(frame));
}

// Each combination of words that frames have, once: fields, palettes, files, texts.
void FilmScene::check_words() {
  const Scene first = scene_at(0);
  std::set<std::vector<std::string>> checked;
  for (int frame = 0; frame < path_->frame_count(); ++frame) {
    std::vector<std::string> words;
    const std::vector<std::string>& settings = path_->settings(frame);
    std::copy_if(settings.begin(), settings.end(), std::back_inserter(words), has_words);
    if (words.empty() || !checked.insert(words).second) continue;
    try {
      const Scene scene = scene_at(frame);
      const bool is_the_same = scene.snapshot == first.snapshot;
      check_load(scene, is_the_same ? *snapshot_at(first) : *SnapshotSource().at(scene));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("frame {} of the path: {}", frame, error.what()));
    }
  }
}

// The first frame in which there is something of a component to be seen decides; only so many
// later ones are tried, over all of the film.
void FilmScene::decide_components() {
  constexpr int most_later = 16;
  const int last = path_->frame_count() - 1;
  std::vector<std::string> ignored;
  for (int i = 0; i <= most_later; ++i) {
    const Scene scene = scene_at(static_cast<int>(std::int64_t{last} * i / most_later));
    scene_ = fixed_scene(splotchcl::decide(scene, *snapshot_at(scene), i == 0 ? notes_ : ignored));
    if (is_decided(scene_) || last == 0) return;
  }
  notes_.push_back(
      "the first frames show nothing of a component: each frame decides its ranges and its "
      "reference_column anew, which may flicker; set them in the scene");
}

}  // namespace splotchcl
