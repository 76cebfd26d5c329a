#include "certificate/block_sums.h"

#include <algorithm>

namespace splotchcl {

BlockSums::BlockSums(const CellSums& cells, int margin)
    : margin_(margin), columns_(cells.columns), rows_(cells.rows) {
  stride_ = columns_ + 2 * margin_ + 1;
  const std::ptrdiff_t lines = rows_ + 2 * margin_ + 1;
  sums_.resize(static_cast<std::size_t>(stride_ * lines));
  const float* value = cells.values.data();
  for (std::ptrdiff_t y = margin_ + 1; y < lines; ++y) {
    const double* above = sums_.data() + (y - 1) * stride_;
    double* here = sums_.data() + y * stride_;
    if (y > margin_ + rows_) {
      std::copy_n(above, stride_, here);
      continue;
    }
    double of_row = 0;
    for (std::ptrdiff_t x = margin_ + 1; x < stride_; ++x) {
      if (x <= margin_ + columns_) of_row += static_cast<double>(*value++);
      here[x] = above[x] + of_row;
    }
  }
}

double BlockSums::over(const CellRange& range) const {
  const auto within = [this](int value, std::ptrdiff_t size) {
    return static_cast<int>(std::clamp<std::ptrdiff_t>(value, -margin_, size + margin_));
  };
  return over_near({within(range.x0, columns_), within(range.x1, columns_), within(range.y0, rows_),
                    within(range.y1, rows_)});
}

}  // namespace splotchcl
