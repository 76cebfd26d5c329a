#pragma once

#include <cstddef>
#include <vector>

#include "certificate/peak_cells.h"

namespace splotchcl {

// Cells x0 .. x1 - 1 in rows y0 .. y1 - 1.
struct CellRange {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;

  CellRange widened(int by) const { return {x0 - by, x1 + by, y0 - by, y1 + by}; }
};

// Sums over rectangles of cells, in constant time each: a summed-area table with a margin of
// empty cells around it. What lies farther out counts as 0, too.
class BlockSums {
 public:
  BlockSums(const CellSums& cells, int margin);

  double over(const CellRange& range) const;
  double total() const { return sums_.back(); }
  // The same where the range lies within the margin.
  double over_near(const CellRange& range) const {
    const double* top = sums_.data() + (range.y0 + margin_) * stride_ + margin_;
    const double* bottom = top + (range.y1 - range.y0) * stride_;
    return bottom[range.x1] - top[range.x1] - bottom[range.x0] + top[range.x0];
  }

 private:
  int margin_;
  std::ptrdiff_t columns_, rows_, stride_;
  std::vector<double> sums_;  // (columns + 2 margin + 1) x (rows + 2 margin + 1)
};

}  // namespace splotchcl
