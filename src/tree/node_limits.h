#pragma once

#include <vector>

#include "splotchcl/frame_check.h"
#include "tree/error_cells.h"
#include "tree/node_weighing.h"

namespace splotchcl {

// Up to what nodes of each cell are kept: alike at all levels, since then the fewest nodes take
// what is promised (docs/dev/accuracy.md, Merged particles).
class NodeLimits {
 public:
  // Six standard deviations of a pixel are to be at most `error`, over max(1, light / 2) where
  // light only adds up, or a part of that in each block; where there are none, all of it.
  NodeLimits(double error, bool has_sums, const BlockErrors& parts, const Rectangle& crop);

  // Of all that is drawn, as far as it is known: what may be erred by follows from it, and until
  // correct() was called what a node may.
  void see(const ErrorCells& light);
  bool keeps(const WeighedNode& node, const ErrorCells& cells) const;
  // After all nodes were looked at with these limits: nodes have taken so much.
  void correct(const ErrorCells& used);
  // The largest standard deviation of what nodes err by that was taken, over what is promised.
  double largest_part(const ErrorCells& used) const;

 private:
  double promised(double light) const;

  double error_;
  bool has_sums_, is_corrected_ = false;
  CellNumbers parts_;     // of the error; of larger cells the least within
  CellNumbers promised_;  // variances of a pixel
  CellNumbers of_node_;   // squared errors, added up over pixels
};

// Its part of the variance of a pixel of its cell.
double variance_of(const WeighedNode& node, const ErrorCells& cells);

}  // namespace splotchcl
