#pragma once

#include <vector>

namespace splotchcl {

// How a keyframe is gone through.
struct Stop {
  double frame = 0;
  double dwell = 0;       // frames
  bool is_eased = false;  // whether the speed is 0 there, as it is where it dwells
};

// At which place of a curve through keyframes a film is at a frame: the frame itself but where
// keyframes are eased or dwell. Never goes back, and its speed never jumps.
class KeyframePace {
 public:
  // By rising frames; each ends its dwelling before the next.
  explicit KeyframePace(std::vector<Stop> stops) : stops_(stops) {}

  // Whether there is anything but the frame itself.
  static bool changes(const std::vector<Stop>& stops);
  double place_at(double frame) const;

 private:
  std::vector<Stop> stops_;
};

}  // namespace splotchcl
