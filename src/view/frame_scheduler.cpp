#include "view/frame_scheduler.h"

namespace splotchcl::view {

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
