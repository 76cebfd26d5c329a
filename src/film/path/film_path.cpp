#include "film/path/film_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/path/camera_course.h"
#include "film/path/followed_way.h"
#include "film/path/keyframe_tracks.h"
#include "film/path/path_table.h"
#include "film/path/view_line.h"
#include "scene/constants.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

// What the parts of a path together set at its frames, and between them.
class FrameSettings {
 public:
  // `table` may be null. `find` is asked for what is followed, if anything is. `notes` takes what
  // the user should know. Throws UsageError.
  FrameSettings(const Scene& scene, const PathTable* table, int frames, const FindFollowed& find,
                std::vector<std::string>& notes);

  FrameSettings(const FrameSettings&) = delete;
  FrameSettings& operator=(const FrameSettings&) = delete;

  // "key=value". Without a table also between frames.
  std::vector<std::string> at(double frame) const;

 private:
  std::vector<std::string> without_course(double frame) const;
  double index_at(double frame) const;
  std::optional<FollowedWay> find_way(const Scene& scene, const FindFollowed& find) const;
  void limit_turns(const Scene& scene, std::vector<std::string>& notes);
  void turn_slowly(double frame, std::vector<std::string>& settings) const;

  const PathTable* table_;
  int frames_;
  double scene_index_;
  Camera camera_;  // where nothing moves it
  KeyframeTracks keyframes_;
  std::optional<CameraCourse> course_;
  std::optional<CameraMotion> motion_;
  std::vector<Vec3> views_;  // of each frame, where the path's own turn too fast
};

constexpr double degrees = 180 / pi;

void append(std::vector<std::string>& settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
}

std::optional<double> index_in(const std::vector<std::string>& settings) {
  const std::string start = "time.index=";
  std::optional<double> index;
  for (const std::string& setting : settings) {
    if (setting.rfind(start, 0) != 0) continue;
    const toml::table value = scene_file::parse_value(setting.substr(start.size()));
    index = scene_file::number().read(*value.get("value"));
  }
  return index;
}

Vec3 direction_of(const ViewLine& line) {
  return boost::qvm::normalized(line.look_at - line.position);
}

// What to do about a film that turns so many times too fast. Keyframes have frames of their own.
std::string slower_film(const Scene& scene, int frames, double times) {
  if (!scene.path.keyframes.empty() || !scene.path.file.empty())
    return "a path that turns less, or keyframes that lie farther apart";
  constexpr double rounding = 1e-9;
  const auto wanted = static_cast<int>(std::ceil(frames * times * (1 - rounding)));
  return fmt::format("--set movie.frames={} or more, or a path that turns less", wanted);
}

FrameSettings::FrameSettings(const Scene& scene, const PathTable* table, int frames,
                             const FindFollowed& find, std::vector<std::string>& notes)
    : table_(table),
      frames_(frames),
      scene_index_(scene.time.index.value_or(0)),
      camera_(scene.camera.value_or(Camera())),
      keyframes_(scene) {
  course_.emplace(scene, frames, find_way(scene, find),
                  [this](double frame) { return index_at(frame); });
  motion_.emplace(course_->start(), frames);
  keyframes_ = KeyframeTracks(course_->start());
  limit_turns(scene, notes);
}

std::optional<FollowedWay> FrameSettings::find_way(const Scene& scene,
                                                   const FindFollowed& find) const {
  if (!scene.path.follow) return std::nullopt;
  if (!find) {
    throw UsageError(
        "path.follow: found it where no particles are at hand, expected a path without it");
  }
  std::vector<double> indices;
  for (int frame = 0; frame < frames_; ++frame)
    indices.push_back(index_at(frame));
  return find(scene, indices);
}

// Of what does not depend on where the camera is.
double FrameSettings::index_at(double frame) const {
  std::vector<std::string> settings;
  if (table_ != nullptr) settings = table_->settings(static_cast<int>(frame));
  append(settings, keyframes_.settings(frame));
  return index_in(settings).value_or(scene_index_);
}

std::vector<std::string> FrameSettings::without_course(double frame) const {
  std::vector<std::string> settings;
  if (table_ != nullptr) settings = table_->settings(static_cast<int>(frame));
  append(settings, motion_->settings(frame));
  append(settings, keyframes_.settings(frame));
  return settings;
}

std::vector<std::string> FrameSettings::at(double frame) const {
  std::vector<std::string> settings = without_course(frame);
  course_->apply(frame, settings);
  if (!views_.empty()) turn_slowly(frame, settings);
  return settings;
}

void FrameSettings::limit_turns(const Scene& scene, std::vector<std::string>& notes) {
  if (!scene.path.max_turn_rate) return;
  const double most = *scene.path.max_turn_rate / degrees / scene.movie.frames_per_second;
  std::vector<Vec3> views;
  for (int frame = 0; frame < frames_; ++frame)
    views.push_back(direction_of(ViewLine(camera_, at(frame))));
  const double largest = largest_turn(views);
  if (largest <= most) return;
  std::vector<Vec3> slow = with_slow_turns(views, most);
  const double found = largest * degrees * scene.movie.frames_per_second;
  if (slow.empty()) {
    throw UsageError(fmt::format(
        "path.max_turn_rate: found a view that turns by {:.3g} degrees per second, and all along "
        "the film faster than the {:g} that it may, expected {}",
        found, *scene.path.max_turn_rate, slower_film(scene, frames_, largest / most)));
  }
  double farthest = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
    farthest = std::max(farthest, angle_between(views[i], slow[i]));
  notes.push_back(fmt::format(
      "path.max_turn_rate: the view would turn by up to {:.3g} degrees per second, and looks ahead "
      "to turn by {:g} at most; it is up to {:.2g} degrees from the path's own",
      found, *scene.path.max_turn_rate, farthest * degrees));
  views_ = std::move(slow);
}

void FrameSettings::turn_slowly(double frame, std::vector<std::string>& settings) const {
  ViewLine line(camera_, settings);
  const double place = std::clamp(frame, 0.0, static_cast<double>(frames_ - 1));
  const auto before = static_cast<std::size_t>(place);
  const std::size_t after = std::min(before + 1, views_.size() - 1);
  const double part = place - std::floor(place);
  const Vec3 view =
      boost::qvm::normalized(Vec3((1 - part) * views_[before] + part * views_[after]));
  line.look_at = line.position + boost::qvm::mag(line.look_at - line.position) * view;
  line.put_into(settings);
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

// Rows are of whole frames.
void refuse_blur_of(const std::optional<PathTable>& table) {
  if (!table) return;
  throw UsageError(
      "movie.motion_blur: found it beside path.file, which says nothing between frames, expected "
      "an orbit, a flight or keyframes");
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
  // They begin with what the scene's camera shows.
  if (path.follow || path.approach) return false;
  if (path.fly) return true;
  if (!path.file.empty()) {
    const PathTable table(path.file, scene);
    if (table.sets("camera.position") && table.sets("camera.look_at")) return true;
  }
  return !path.keyframes.empty() && path.keyframes.front().values.count("camera.position") > 0 &&
         path.keyframes.front().values.count("camera.look_at") > 0;
}

FilmPath::FilmPath(const Scene& as_given, std::vector<std::string>& notes,
                   const FindFollowed& find) {
  const Scene scene = with_simple_path(as_given, notes);
  if (!scene.path.file.empty()) {
    table_.emplace(scene.path.file, scene);
    settle_snapshot_index(*table_, scene, notes);
  }
  const int frames = count_frames(scene, table_);
  const FrameSettings settings(scene, table_ ? &*table_ : nullptr, frames, find, notes);
  for (int frame = 0; frame < frames; ++frame)
    settings_.push_back(settings.at(frame));
  if (!scene.movie.motion_blur) return;
  refuse_blur_of(table_);
  const MotionBlur& blur = *scene.movie.motion_blur;
  samples_ = static_cast<std::size_t>(blur.samples);
  for (int frame = 0; frame < frames; ++frame) {
    for (int i = 0; i < blur.samples; ++i) {
      const double place = frame + blur.shutter * ((i + 0.5) / blur.samples - 0.5);
      blurred_.push_back(settings.at(std::clamp<double>(place, 0, frames - 1)));
    }
  }
}

const std::vector<std::string>& FilmPath::settings(int frame) const {
  return settings_.at(static_cast<std::size_t>(frame));
}

Scene FilmPath::scene_at(const Scene& scene, int frame) const {
  return scene_of(scene, frame, settings(frame));
}

std::vector<Scene> FilmPath::blurred_scenes(const Scene& scene, int frame) const {
  std::vector<Scene> scenes;
  const std::size_t first = static_cast<std::size_t>(frame) * samples_;
  for (std::size_t i = 0; i < samples_; ++i)
    scenes.push_back(scene_of(scene, frame, blurred_.at(first + i)));
  return scenes;
}

Scene FilmPath::scene_of(const Scene& scene, int frame,
                         const std::vector<std::string>& settings) const {
  try {
    Scene numbered = scene;
    numbered.finish.frame = frame;
    return apply_settings(numbered, settings);
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
