#include "film/path/film_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "film/path/frame_settings.h"
#include "film/path/simplify_path.h"
#include "splotchcl/error.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

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
