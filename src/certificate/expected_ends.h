#pragma once

#include <array>
#include <vector>

#include "scene/plan/cloud_sample.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What the ends of splats will do where they do most, over what is promised.
struct ExpectedEnds {
  double error = 0;
  std::array<double, width_octaves> of_octaves{};  // its parts
};

// Of all clouds of a frame that has no grid but the picture's own, by the sums of the check
// (docs/dev/accuracy.md, "Checked after drawing").
ExpectedEnds expected_ends(const std::vector<SampledCloud>& clouds, const Frame& frame,
                           const FramePlan& plan, const BlockLoop& loop = one_after_the_other);

}  // namespace splotchcl
