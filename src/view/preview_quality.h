#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace splotchcl::view
