#include "film/path/frame_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "film/path/turn_limit.h"
#include "film/path/view_line.h"
#include "scene/constants.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

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

}  // namespace

FrameSettings::FrameSettings(const Scene& scene, const PathTable* table, int frames,
                             const FindFollowed& find, std::vector<std::string>& notes)
    : table_(table),
      frames_(frames),
      scene_index_(scene.time.index),
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

}  // namespace splotchcl
