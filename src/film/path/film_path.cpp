#include "film/path/film_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "film/path/keyframe_tracks.h"
#include "scene/curves.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

// The camera on an orbit or a flight, or standing still.
class CameraMotion {
 public:
  // An orbit needs a scene with a camera. Throws UsageError.
  CameraMotion(const Scene& scene, int frames);

  // "key=value" for what moves.
  std::vector<std::string> settings(int frame) const;

 private:
  std::vector<std::string> on_orbit(int frame) const;
  std::vector<std::string> on_flight(int frame) const;

  PathSettings path_;
  Camera camera_;
  int frames_;
  std::optional<Flight> flight_;
  double look_ahead_ = 0;
};
using boost::qvm::mag;

std::string setting(const std::string& key, const Vec3& value) {
  return "camera." + key + "=" + scene_file::vector().write(value);
}

void check_orbit(const Orbit& orbit, const Camera& camera) {
  if (orbit.axis && !(mag(*orbit.axis) > 0)) {
    throw UsageError("path.orbit.axis: found [0, 0, 0], expected any direction");
  }
  const Vec3 center = orbit.center.value_or(camera.look_at);
  if (orbit.radius && !(mag(camera.position - center) > 0)) {
    throw UsageError(
        "path.orbit.radius: found a camera that stands at the center of its orbit, expected it "
        "elsewhere, in the direction in which the orbit begins");
  }
}

Flight make_flight(const FlyThrough& fly) {
  for (std::size_t i = 1; i < fly.through.size(); ++i) {
    if (mag(fly.through[i] - fly.through[i - 1]) > 0) continue;
    throw UsageError(
        fmt::format("path.fly.through: found point {} twice in a row, expected each point to "
                    "differ from the one before",
                    scene_file::vector().write(fly.through[i])));
  }
  return Flight(fly.through);
}

CameraMotion::CameraMotion(const Scene& scene, int frames)
    : path_(scene.path), camera_(scene.camera.value_or(Camera())), frames_(frames) {
  if (path_.orbit) check_orbit(*path_.orbit, camera_);
  if (!path_.fly) return;
  flight_ = make_flight(*path_.fly);
  // The distance counts where the picture's scale or a pair of eyes depends on it.
  look_ahead_ = scene.camera ? mag(camera_.look_at - camera_.position) : flight_->length();
}

std::vector<std::string> CameraMotion::settings(int frame) const {
  if (path_.orbit) return on_orbit(frame);
  if (path_.fly) return on_flight(frame);
  return {};
}

std::vector<std::string> CameraMotion::on_orbit(int frame) const {
  const Orbit& orbit = *path_.orbit;
  const double degrees = orbit.degrees * frame / frames_;
  const Vec3 center = orbit.center.value_or(camera_.look_at);
  const Vec3 axis = orbit.axis.value_or(camera_.sky);
  Vec3 start = camera_.position;
  if (orbit.radius) {
    const Vec3 arm = start - center;
    start = center + *orbit.radius / mag(arm) * arm;
  }
  std::vector<std::string> settings = {setting("position", turned(start, center, axis, degrees))};
  // What lies on the axis stays, exactly.
  if (orbit.center)
    settings.push_back(setting("look_at", turned(camera_.look_at, center, axis, degrees)));
  if (orbit.axis) {
    settings.push_back(setting("sky", turned(camera_.sky, Vec3{{0, 0, 0}}, axis, degrees)));
  }
  return settings;
}

std::vector<std::string> CameraMotion::on_flight(int frame) const {
  const double t = frames_ > 1 ? static_cast<double>(frame) / (frames_ - 1) : 0;
  const Flight::State state = flight_->at(path_.fly->is_eased ? t * t * (3 - 2 * t) : t);
  const Vec3 ahead = state.position + look_ahead_ * state.direction;
  return {setting("position", state.position),
          setting("look_at", path_.fly->look_at.value_or(ahead))};
}

const std::string index_key = "time.index";

// Files of the original program name the snapshot in each row. Where all name the same one,
// it is the scene's.
void settle_snapshot_index(PathTable& table, const Scene& scene, std::vector<std::string>& notes) {
  if (!table.sets(index_key) || scene.time.is_set()) return;
  if (!table.is_constant(index_key)) {
    throw UsageError(
        fmt::format("{}: the index of the snapshot changes from row to row, expected a scene with "
                    "a sequence of snapshots; add a [time] table",
                    scene.path.file));
  }
  notes.push_back(fmt::format(
      "{}: the index of the snapshot is the same in every row and the scene has one snapshot: that "
      "one is drawn",
      scene.path.file));
  table.drop(index_key);
}

int count_frames(const Scene& scene, const std::optional<PathTable>& table) {
  const std::optional<int>& wanted = scene.movie.frames;
  if (table) {
    if (wanted && *wanted != table->row_count()) {
      throw UsageError(
          fmt::format("movie.frames: found {}, expected {}, as many as {} has rows, or "
                      "no movie.frames at all",
                      *wanted, table->row_count(), scene.path.file));
    }
    return table->row_count();
  }
  if (wanted) return *wanted;
  if (!scene.path.keyframes.empty()) {
    return static_cast<int>(std::floor(scene.path.keyframes.back().frame)) + 1;
  }
  throw UsageError(
      scene.path.is_set()
          ? "movie.frames: found nothing, expected the number of frames of the orbit or flight"
          : "path: found nothing, expected how the film moves: a file, keyframes, an orbit or a "
            "fly-through in a [path] table, or only movie.frames for a scene that stays");
}

void append(std::vector<std::string>& settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
}

// "camera.sky" of "setting "...": key camera.sky: found ...", and what follows.
struct KeyMessage {
  std::string label, text;
};
std::optional<KeyMessage> split_message(const std::string& message) {
  const std::string mark = ": key ";
  const std::size_t key = message.find(mark);
  if (key == std::string::npos) return std::nullopt;
  const std::size_t begin = key + mark.size();
  const std::size_t end = message.find(": ", begin);
  if (end == std::string::npos) return std::nullopt;
  return KeyMessage{message.substr(begin, end - begin), message.substr(end + 2)};
}

}  // namespace

bool path_has_camera(const Scene& scene) {
  const PathSettings& path = scene.path;
  if (path.fly) return true;
  if (!path.file.empty()) {
    const PathTable table(path.file, scene);
    if (table.sets("camera.position") && table.sets("camera.look_at")) return true;
  }
  return !path.keyframes.empty() && path.keyframes.front().values.count("camera.position") > 0 &&
         path.keyframes.front().values.count("camera.look_at") > 0;
}

FilmPath::FilmPath(const Scene& scene, std::vector<std::string>& notes) {
  if (!scene.path.file.empty()) {
    table_.emplace(scene.path.file, scene);
    settle_snapshot_index(*table_, scene, notes);
  }
  const int frames = count_frames(scene, table_);
  const KeyframeTracks keyframes(scene);
  const CameraMotion motion(scene, frames);
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<std::string> settings;
    if (table_) append(settings, table_->settings(frame));
    append(settings, motion.settings(frame));
    append(settings, keyframes.settings(frame));
    settings_.push_back(settings);
  }
}

const std::vector<std::string>& FilmPath::settings(int frame) const {
  return settings_.at(static_cast<std::size_t>(frame));
}

Scene FilmPath::scene_at(const Scene& scene, int frame) const {
  try {
    Scene numbered = scene;
    numbered.finish.frame = frame;
    return apply_settings(numbered, settings(frame));
  } catch (const UsageError& error) {
    const std::optional<KeyMessage> message = split_message(error.what());
    if (!message) throw UsageError(where(frame, "") + ": " + error.what());
    throw UsageError(
        fmt::format("{}: key {}: {}", where(frame, message->label), message->label, message->text));
  }
}

void FilmPath::check(const Scene& scene) const {
  for (int frame = 0; frame < frame_count(); ++frame)
    (void)scene_at(scene, frame);
}

std::string FilmPath::where(int frame, const std::string& label) const {
  if (table_) return table_->where(frame, label);
  return fmt::format("frame {} of the path", frame);
}

}  // namespace splotchcl
