#pragma once

#include <optional>

namespace splotchcl {

// A periodic box: a particle stands for its images at every multiple of `box` along each
// axis. With `wrap` the image nearest to the look-at point is drawn (the nearest along each
// axis by itself).
struct PeriodicSettings {
  bool wrap = false;
  std::optional<double> box;  // > 0, in the snapshot's length unit; unset: as its header says
};

}  // namespace splotchcl
