#pragma once

#include <vector>

#include "certificate/cells.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// How well a drawn picture keeps its promise, from all of its splats.
struct Certificate {
  double error_of_promise = 0;  // the largest of any block of pixels
  ErrorParts worst;             // of that block
  ErrorParts worst_kept;        // of the block with the largest one up to 1
  BlockErrors blocks;
  // What is to be added to the plan's, where the promise is not kept.
  SplatNeeds needs;
  // Where one was asked for (FramePlan::certify): else nothing bounds what colors do.
  bool is_bound = true;
  // Nothing but extended precision gives what is promised.
  bool needs_extended = false;
  bool keeps_promise() const { return error_of_promise <= 1; }
};

struct CollectedSplats {
  std::vector<PeakCells> cells;
  double longest_list = 0;  // splats of one tile
  // What any order within slabs could change of the picture's blocks (BlockErrors) at most; none
  // where there are no slabs.
  std::vector<float> of_slabs;
  double around = 0;  // the part of the promise that clouds around the camera spend
  // How deep the deepest channel of each block is, where needs_depths().
  std::vector<float> depths = {};
};

// Whether CollectedSplats::depths are looked at: in order, and in sums where colors are rounded.
bool needs_depths(const Frame& frame, const FramePlan& plan);

// docs/dev/accuracy.md ("Checked after drawing") derives it and says what is a bound. `edge`: so
// many blocks along the sides count for nothing. Splats of a crop that lie beyond it count as if
// they lay at its sides.
Certificate certify(const CollectedSplats& splats, const Image& image, const Frame& frame,
                    const FramePlan& plan, int edge = 0);

// Of a picture in extended precision, which keeps its promise whatever the splats, but for the
// colors of light that is far brighter in one channel than in another.
Certificate certify_extended(const CollectedSplats& splats, const Image& image, const Frame& frame,
                             const FramePlan& plan);

}  // namespace splotchcl
