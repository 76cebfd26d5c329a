#include "film/frames/film_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "common/file_identity.h"
#include "common/words.h"
#include "film/follow/followed_particles.h"
#include "film/path/film_path.h"
#include "load/passes.h"
#include "load/suggest_camera.h"
#include "scene_file/values.h"
#include "sequence/snapshot_source.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/film.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_source.h"

namespace splotchcl {
namespace {

constexpr int usual_frames = 250;  // ten seconds

const char* option_of(const FilmTarget& target) {
  return target.is_approached ? "--dive" : "--follow";
}

Follow follow_of(const FilmTarget& target) {
  Follow follow;
  if (target.name == "densest") return follow;
  const std::string start = "halo=";
  if (target.name.rfind(start, 0) == 0)
    follow.halo = parse_whole_number(target.name.substr(start.size()));
  if (follow.halo) return follow;
  throw UsageError(fmt::format("{}: found {}, expected densest, or halo=N with a halo's number",
                               option_of(target), target.name));
}

Keyframe at_index(double frame, double index) {
  Keyframe keyframe;
  keyframe.frame = frame;
  keyframe.values["time.index"] = scene_file::write_number(index);
  return keyframe;
}

// Through the whole time; where nothing comes between snapshots, from one to the next.
std::vector<Keyframe> time_lapse(const Scene& scene, const std::vector<ListedSnapshot>& list) {
  const int last = *scene.movie.frames - 1;
  if (list.size() < 2 || last == 0) return {};
  if (scene.time.interpolation != Interpolation::none)
    return {at_index(0, list.front().index), at_index(last, list.back().index)};
  std::vector<Keyframe> keyframes;
  const double step = static_cast<double>(last) / static_cast<double>(list.size() - 1);
  for (const ListedSnapshot& snapshot : list)
    keyframes.push_back(at_index(step * static_cast<double>(keyframes.size()), snapshot.index));
  return keyframes;
}

// A full turn about a snapshot, a part of one about what changes.
Orbit slow_orbit(bool is_series) {
  Orbit orbit;
  orbit.degrees = is_series ? 90 : 360;
  orbit.is_eased = true;
  return orbit;
}

std::string note_of(const Scene& scene, std::size_t snapshots) {
  const std::string time = snapshots > 0 ? counted(snapshots, "snapshot") + " and " : std::string();
  return fmt::format("no path: {}an orbit of {:g} degrees in {} (path, movie.frames)", time,
                     scene.path.orbit->degrees, counted(*scene.movie.frames, "frame"));
}

// Scenes that were opened have one, where they have a sequence.
double index_in(const Scene& scene) {
  return scene.time.index.value_or(0);
}

// Where what the film follows is: in a periodic box from the film's first moment, else only where
// it is chosen.
FollowedWay find_target(const Scene& scene, bool has_box) {
  if (scene.path.keyframes.empty()) return find_followed(scene, {index_in(scene)});
  const std::vector<ListedSnapshot> list = list_sequence(scene.time);
  std::vector<double> indices = {list.back().index};
  if (has_box) indices.push_back(list.front().index);
  return find_followed(scene, indices);
}

// The box is shown around the target from the start: nothing comes in at its faces while the camera
// goes there.
void show_box_around(const FollowedWay& target, Scene& scene) {
  using namespace boost::qvm;
  scene.periodic.wrap = true;
  const bool is_series = !scene.path.keyframes.empty();
  const double begin = is_series ? list_sequence(scene.time).front().index : index_in(scene);
  const Vec3 shift = target.center(begin) - scene.camera->look_at;
  scene.camera->look_at += shift;
  scene.camera->position += shift;
}

constexpr std::size_t most_looked_at = 5;

// Of the first snapshot, the last, and some between; none where one fills a box, which looks alike
// at all times.
std::vector<Target> targets_of_course(const Scene& scene) {
  const std::vector<ListedSnapshot> list = list_sequence(scene.time);
  const std::size_t count = std::min(list.size(), most_looked_at);
  std::vector<Target> targets;
  SnapshotSource snapshots;
  for (std::size_t k = 0; k < count; ++k) {
    Scene at = scene;
    at.time.index = list[count == 1 ? 0 : k * (list.size() - 1) / (count - 1)].index;
    targets.push_back(suggest_target(*snapshots.at(at), types_of(at.components), at.image));
    if (targets.back().shape == Target::Shape::box) return {};
  }
  return targets;
}

// Holds all of them, from any side: those of other times lie beside the middle.
Target target_around(const std::vector<Target>& targets) {
  using namespace boost::qvm;
  Target around = targets.back();
  Vec3 least = around.center, most = around.center;
  for (const Target& target : targets) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least.a[axis] = std::min(least.a[axis], target.center.a[axis]);
      most.a[axis] = std::max(most.a[axis], target.center.a[axis]);
    }
  }
  around.center = 0.5 * (least + most);
  around.size = 0;
  for (const Target& target : targets)
    around.size = std::max(around.size, mag(target.center - around.center) + target.size);
  return around;
}

// How wide the picture of what is followed is, of what the scene's camera shows.
double part_of_view(const FollowedWay& target, const Scene& scene) {
  const CameraFrame shown = make_camera_frame(*scene.camera, scene.image.width, scene.image.height);
  const double side = std::min(scene.image.width, scene.image.height) / shown.pixels_per_length;
  return scene.path.follow->size * target.radius() / side;
}

// Matter that the camera meets on its way around the target would lie over it as a veil.
void let_matter_fade_before_target(double part_of_view, Scene& scene) {
  using namespace boost::qvm;
  constexpr double part_of_way = 0.5;
  Camera& camera = *scene.camera;
  if (camera.near_limit || camera.fade.near_length > 0) return;
  const double way = mag(camera.look_at - camera.position);
  camera.fade.near_length = part_of_way * way * part_of_view;
}

// Moves the camera of a sequence's suggested scene so far away that it shows what there is at any
// time, from wherever an orbit leads it. Periodic boxes stay as they are. Throws as readers do.
void show_whole_course(Scene& scene) {
  const std::vector<Target> targets = targets_of_course(scene);
  if (!targets.empty()) scene.camera = suggest_camera(target_around(targets), scene.image);
}

// Matter around a camera that was chosen to stand amid it fades. Not where the camera goes: what it
// goes to would fade as well.
void let_no_matter_fade(const Camera& suggested, Camera& camera) {
  if (camera.fade.near_length != suggested.fade.near_length || suggested.through_clouds) return;
  camera.fade.near_length = 0;
  camera.through_clouds = true;
}

// Gives a scene that says nothing of a film one that suits its data: an orbit around what a
// snapshot shows, or a sequence in its order of time with a slow orbit. With a dive it goes from
// what the scene's camera shows to the densest place or a halo, through time where there is a
// sequence; or it orbits around that all along. What the scene says of frames stays. The scene has
// a camera, and its components. `snapshot` is one of the scene's. Throws UsageError for a target
// that is none, and for one in a scene with a path. Returns a note of what was chosen, or "".
std::string suggest_film(const FilmTarget& target, const Snapshot& snapshot, Scene& scene) {
  PathSettings& path = scene.path;
  const bool has_target = !target.name.empty(), is_series = scene.time.is_set();
  if (path.is_set() && has_target) {
    throw UsageError(fmt::format(
        "{}: found it for a scene with a [path], expected a scene or a snapshot without one; "
        "path.follow and path.approach say the same in a scene",
        option_of(target)));
  }
  if (path.is_set()) return "";
  const std::vector<ListedSnapshot> list =
      is_series ? list_sequence(scene.time) : std::vector<ListedSnapshot>();
  const bool has_jumps = is_series && scene.time.interpolation == Interpolation::none;
  if (!scene.movie.frames)
    scene.movie.frames = has_jumps ? static_cast<int>(list.size()) : usual_frames;
  if (has_jumps) path.is_smooth = false;
  path.keyframes = time_lapse(scene, list);
  if (!target.is_approached) path.orbit = slow_orbit(is_series);
  if (!has_target) return note_of(scene, list.size());
  path.follow = follow_of(target);
  const bool has_box = filled_box(scene, snapshot).has_value();
  const FollowedWay followed = find_target(scene, has_box);
  if (has_box) show_box_around(followed, scene);
  const double part = part_of_view(followed, scene);
  // A dive comes nearer where its target is all that there is, and nothing that is followed is
  // shown smaller than in the picture of all.
  const double largest_part = target.is_approached ? 0.25 : 1;
  if (part > largest_part) path.follow->size *= largest_part / part;
  if (!target.is_approached) {
    let_matter_fade_before_target(std::min(part, 1.0), scene);
    return "";
  }
  path.approach.emplace();
  // Close to the densest place there is far more light than in the whole.
  if (!scene.finish.exposure) scene.finish.exposure_follows = true;
  return "";
}

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
  if (!opened.suggested_camera || !opened.scene.camera) return {};
  const Camera &now = *opened.scene.camera, &suggested = *opened.suggested_camera;
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
  if (view.place && view.zoom && scene_.time.is_set()) show_whole_course(scene_);
  if (view.place && !target.name.empty())
    let_no_matter_fade(*opened.suggested_camera, *scene_.camera);
  // A scene file that says how long its film is says what it is, too.
  if (opened.suggested || !target.name.empty() || !scene_.movie.frames) {
    const std::string note = suggest_film(target, *snapshot_at(scene_), scene_);
    if (!note.empty()) notes_.push_back(note);
  }
  if (!scene_.path.is_set() && scene_.movie.frames > 1) {
    notes_.push_back(fmt::format(
        "no path: all {} frames are alike; path.orbit.degrees=360 turns the camera, and "
        "without movie.frames a path is chosen",
        *scene_.movie.frames));
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
      find_place(list, index_in(scene_at(frame)));
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
