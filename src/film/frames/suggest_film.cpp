#include "film/frames/suggest_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/words.h"
#include "film/follow/find_followed.h"
#include "film/follow/followed_particles.h"
#include "load/suggest_camera.h"
#include "scene_file/values.h"
#include "sequence/list_sequence.h"
#include "splotchcl/error.h"
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
  const std::string time = snapshots > 0 ? fmt::format("{} snapshots and ", snapshots) : "";
  return fmt::format("no path: {}an orbit of {:g} degrees in {} frames (path, movie.frames)", time,
                     scene.path.orbit->degrees, *scene.movie.frames);
}

// In a periodic box the box is shown around the target from the start: nothing comes in at its
// faces while the camera goes there.
void show_box_around_target(const Snapshot& snapshot, Scene& scene) {
  using namespace boost::qvm;
  if (!filled_box(scene, snapshot)) return;
  scene.periodic.wrap = true;
  std::vector<double> indices = {scene.time.index};
  if (!scene.path.keyframes.empty()) indices.push_back(list_sequence(scene.time).front().index);
  const Vec3 shift = find_followed(scene, indices).center(indices.back()) - scene.camera->look_at;
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
    targets.push_back(suggest_target(*snapshots.at(at), types_of(at.components), at.image.width,
                                     at.image.height));
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
double part_of_view(const Scene& scene) {
  const CameraFrame shown = make_camera_frame(*scene.camera, scene.image.width, scene.image.height);
  const double side = std::min(scene.image.width, scene.image.height) / shown.pixels_per_length;
  return scene.path.follow->size * find_followed(scene, {scene.time.index}).radius() / side;
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

}  // namespace

void show_whole_course(Scene& scene) {
  const std::vector<Target> targets = targets_of_course(scene);
  if (!targets.empty()) scene.camera = suggest_camera(target_around(targets));
}

void stand_amid_matter(Camera& camera, bool has_target) {
  // What a picture of 45 degrees shows from afar is half as wide as the way to it, or wider.
  constexpr double part_of_way = 0.2;
  if (!is_wide_angle(camera.projection)) return;
  const Vec3 way = camera.position - camera.look_at;
  camera.position = Vec3(camera.look_at + part_of_way * way);
  if (has_target || camera.near_limit || camera.fade.near_length > 0) return;
  camera.fade.near_length = part_of_way * boost::qvm::mag(way);
  camera.through_clouds = false;
}

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
  show_box_around_target(snapshot, scene);
  if (!target.is_approached) {
    const double part = part_of_view(scene);
    // Nothing is shown smaller than in the picture of all that there is.
    if (part > 1) path.follow->size /= part;
    let_matter_fade_before_target(std::min(part, 1.0), scene);
    return "";
  }
  path.approach.emplace();
  // Close to the densest place there is far more light than in the whole.
  if (!scene.finish.exposure) scene.finish.exposure_follows = true;
  return "";
}

}  // namespace splotchcl
