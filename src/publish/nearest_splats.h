#pragma once

#include <vector>

#include "publish/viewer_splats.h"

namespace splotchcl {

// Splats for viewers, and how far what they show is from what the program shows.
struct NearestSplats {
  std::vector<ViewerSplat> splats;
  LightToOpacity opacity;
  double rms_difference = 0, largest_difference = 0;  // of display values, 0 to 1
};

// Those whose picture by viewers is nearest to `exact`, the frame's light over black, in display
// values and root mean square.
NearestSplats nearest_splats(const std::vector<LightSplat>& splats, const Frame& frame,
                             const Image& exact, const DisplayLight& display);

}  // namespace splotchcl
