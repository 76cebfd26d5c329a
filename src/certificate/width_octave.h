#pragma once

#include <algorithm>
#include <cmath>

#include "scene/plan/cloud_sample.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// In pixels of the picture, widened.
inline double drawn_sigma(const SampledCloud& cloud, const FramePlan& plan) {
  return std::sqrt(cloud.sigma * cloud.sigma + static_cast<double>(plan.splats.widening));
}

// Of a sigma in pixels of the picture (PeakCells::octave).
inline int width_octave(double sigma) {
  return sigma < 1 ? 0 : std::min(std::ilogb(sigma) + 1, width_octaves - 1);
}

}  // namespace splotchcl
