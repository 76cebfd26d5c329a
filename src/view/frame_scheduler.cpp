#include "view/frame_scheduler.h"

namespace splotchcl::view {
namespace {

constexpr std::uint64_t fewest_particles = 32768;
// A finer level takes up to four times as long; one that fits by less would be left again.
constexpr double room_for_finer = 0.25;
constexpr double too_slow = 1.3;
constexpr int frames_of_patience = 60;

}  // namespace

std::vector<PreviewLevel> preview_levels(std::uint64_t particles) {
  std::vector<PreviewLevel> levels;
  std::uint64_t count = fewest_particles;
  levels.push_back({count < particles ? count : 0, 4});
  levels.push_back({count < particles ? count : 0, 2});
  while (count < particles) {
    count *= 4;
    levels.push_back({count < particles ? count : 0, 2});
  }
  levels.push_back({0, 1});
  return levels;
}

PreviewQuality::PreviewQuality(std::uint64_t particles, double target_seconds)
    : levels_(preview_levels(particles)), target_seconds_(target_seconds) {}

void PreviewQuality::drawn(double seconds) {
  if (frames_until_finer_ > 0) --frames_until_finer_;
  if (seconds > too_slow * target_seconds_ && chosen_ > 0) {
    --chosen_;
    frames_until_finer_ = frames_of_patience;
  } else if (seconds < room_for_finer * target_seconds_ && frames_until_finer_ == 0 &&
             chosen_ + 1 < levels_.size()) {
    ++chosen_;
  }
}

std::uint64_t FrameScheduler::take_input(bool is_moving, Time now) {
  is_moving_ = is_moving;
  input_time_ = now;
  return ++newest_;
}

FrameScheduler::Time FrameScheduler::exact_time() const {
  return input_time_ + (is_moving_ ? rest_while_moving : rest);
}

std::optional<FrameScheduler::Task> FrameScheduler::next(Time now) const {
  if (unacknowledged_.size() >= most_unacknowledged) return std::nullopt;
  if (previewed_ != newest_) return Task{Stage::preview, newest_};
  if (exact_ != newest_ && now >= exact_time()) return Task{Stage::exact, newest_};
  return std::nullopt;
}

std::optional<FrameScheduler::Time> FrameScheduler::wake_time() const {
  if (unacknowledged_.size() >= most_unacknowledged || exact_ == newest_) return std::nullopt;
  return exact_time();
}

std::uint64_t FrameScheduler::sent(const Task& task) {
  mark_drawn(task);
  unacknowledged_.insert(++frames_);
  return frames_;
}

void FrameScheduler::mark_drawn(const Task& task) {
  (task.stage == Stage::preview ? previewed_ : exact_) = task.input;
}

}  // namespace splotchcl::view
