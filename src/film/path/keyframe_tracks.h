#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

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

// The keys that a path's keyframes move, each along a curve through its values.
class KeyframeTracks {
 public:
  // Throws UsageError for values of a key that differ in kind, and for directions of length 0.
  explicit KeyframeTracks(const Scene& scene);

  // "key=value" for each key at a frame.
  std::vector<std::string> settings(double frame) const;

 private:
  std::map<std::string, std::function<std::string(double)>> tracks_;  // value at a place
};

}  // namespace splotchcl
