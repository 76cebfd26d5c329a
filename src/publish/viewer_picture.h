#pragma once

#include <vector>

#include "publish/viewer_splats.h"

namespace splotchcl {

// What viewers show of the splats with the frame's camera, over black, in display values: splats
// are sorted by the depth of their middles, each is widened by 0.3 pixels squared and cut where it
// changes less than one of 255 steps or is three deviations away, and lies over those behind it.
Image picture_of_viewers(const std::vector<ViewerSplat>& splats, const Frame& frame);

}  // namespace splotchcl
