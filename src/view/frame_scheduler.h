#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace splotchcl::view {

// How a preview is drawn.
struct PreviewLevel {
  std::uint64_t particles = 0;  // at most; 0: all
  int divisor = 1;              // of the picture's width and height
};

// From the coarsest to all particles at full size. Each takes at most four times as long as the
// one before it.
std::vector<PreviewLevel> preview_levels(std::uint64_t particles);

// Chooses the level at which previews come as often as is asked for, from the time that they took.
class PreviewQuality {
 public:
  PreviewQuality(std::uint64_t particles, double target_seconds);

  const PreviewLevel& level() const { return levels_[chosen_]; }
  // A preview of the level took so long.
  void drawn(double seconds);

 private:
  std::vector<PreviewLevel> levels_;
  std::size_t chosen_ = 0;
  double target_seconds_;
  int frames_until_finer_ = 0;  // after a level that was too slow
};

// What one page is to be drawn next. The newest input wins: inputs in between are never drawn, so
// that there is no backlog. At most two frames are on their way that the page has not acknowledged.
// Each input gets a preview; the exact picture follows once the page is at rest. Knows no clock:
// all times are given.
class FrameScheduler {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class Stage { preview, exact };
  struct Task {
    Stage stage = Stage::preview;
    std::uint64_t input = 0;  // as take_input returned it
  };

  static constexpr std::size_t most_unacknowledged = 2;
  // After an input while something is held down, and after any other.
  static constexpr std::chrono::milliseconds rest_while_moving{300};
  static constexpr std::chrono::milliseconds rest{40};

  // Returns the input's number: 1, 2, ...
  std::uint64_t take_input(bool is_moving, Time now);
  // Nothing: wait for wake_time(), an input or an acknowledgement.
  std::optional<Task> next(Time now) const;
  // When next() will have something without further ado.
  std::optional<Time> wake_time() const;
  // Whether a newer input has made it useless; asked while it is drawn.
  bool is_outdated(const Task& task) const { return task.input != newest_; }

  // Its frame's number, 1, 2, ..., that the page will acknowledge.
  std::uint64_t sent(const Task& task);
  // It failed, and would again.
  void failed(const Task& task) { mark_drawn(task); }
  // Numbers that were not sent are ignored.
  void acknowledge(std::uint64_t frame) { unacknowledged_.erase(frame); }

 private:
  void mark_drawn(const Task& task);
  Time exact_time() const;

  std::uint64_t newest_ = 0;
  bool is_moving_ = false;
  Time input_time_;
  std::uint64_t previewed_ = 0, exact_ = 0;  // the last inputs that were drawn so
  std::uint64_t frames_ = 0;
  std::set<std::uint64_t> unacknowledged_;
};

}  // namespace splotchcl::view
