#pragma once

#include <vector>

#include "splotchcl/frame.h"

namespace splotchcl {

// A particle that may be seen in the picture.
struct SampledCloud {
  double x = 0, y = 0;  // pixels of the whole picture
  double sigma = 0;     // pixels, with kernel.min_radius
  double light = 0;     // or depth, whichever is more, in a pixel: of narrow ones their flux
  double weight = 1;    // particles that it stands for
};

// At most 32768 particles of a frame, those that the whole picture does not show left out. The
// same in every run, and whatever crop is drawn.
std::vector<SampledCloud> sample_clouds(const Frame& frame);

}  // namespace splotchcl
