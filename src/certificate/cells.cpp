#include "certificate/cells.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace splotchcl {
namespace {

// A square of cells of fewer sampled particles tells nothing of how many there are.
constexpr double fewest = 6;
// What the light of n sampled particles may be too large by, in parts of itself times root n.
constexpr double deviations = 2;
// In cells: clouds as wide may lie as far beside the picture.
constexpr double farthest = 1e9;

}  // namespace

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

void CrowdCells::add(double x, double y, double light) {
  const auto cell_of = [this](double place) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(std::ldexp(place, -shift_)), -farthest, farthest));
  };
  cells_.push_back({cell_of(x), cell_of(y), light, 1});
}

void CrowdCells::join_equal_cells() {
  // Splats of a cell are added up in the order that they came in, so that it is the same anywhere.
  std::stable_sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  });
  std::size_t count = 0;
  for (const Cell& cell : cells_) {
    if (count > 0 && cells_[count - 1].x == cell.x && cells_[count - 1].y == cell.y) {
      cells_[count - 1] += cell;
    } else {
      cells_[count++] = cell;
    }
  }
  cells_.resize(count);
}

std::vector<CrowdCells::Row> CrowdCells::rows() const {
  std::vector<Row> rows;
  const Cell* const end = cells_.data() + cells_.size();
  for (const Cell* cell = cells_.data(); cell != end; ++cell) {
    if (rows.empty() || rows.back().begin->y != cell->y) rows.push_back({cell, cell});
    rows.back().end = cell + 1;
  }
  return rows;
}

double CrowdCells::light_within(std::int32_t left, std::int32_t top, std::int32_t side) const {
  double light = 0;
  for (std::int32_t y = top; y < top + side; ++y) {
    auto cell = std::lower_bound(
        cells_.begin(), cells_.end(), std::tie(y, left),
        [](const Cell& a, const auto& place) { return std::tie(a.y, a.x) < place; });
    for (; cell != cells_.end() && cell->y == y && cell->x < left + side; ++cell)
      light += cell->light;
  }
  return light;
}

double CrowdCells::light_of_square(const Cell& square, bool is_sample, double least) const {
  constexpr double cells_in_square = 4, cells_around = 32;
  if (is_sample && square.count < fewest) return least;
  const double certain = is_sample ? 1 - deviations / std::sqrt(square.count) : 1;
  if (certain * square.light <= least) return least;
  const double around = light_within(square.x - 2, square.y - 2, 6) - square.light;
  return std::max(least, certain * square.light - around * cells_in_square / cells_around);
}

// All squares of the two rows, of which either may be empty: of a column alone or with the next.
double CrowdCells::light_of_rows(const Row& upper, const Row& lower, std::int32_t top,
                                 bool is_sample, double least) const {
  const Cell *above = upper.begin, *below = lower.begin;
  std::optional<Cell> before;
  double most = least;
  const auto look_at = [&](const Cell& square) { most = light_of_square(square, is_sample, most); };
  while (above != upper.end || below != lower.end) {
    const bool takes_above = above != upper.end && (below == lower.end || above->x <= below->x);
    const bool takes_below = below != lower.end && (above == upper.end || below->x <= above->x);
    Cell column = {takes_above ? above->x : below->x, top, 0, 0};
    if (takes_above) column += *above++;
    if (takes_below) column += *below++;
    Cell square = column;
    square.x = column.x - 1;
    if (before && before->x == square.x)
      square += *before;
    else if (before)
      look_at(*before);
    look_at(square);
    before = column;
  }
  if (before) look_at(*before);
  return most;
}

double CrowdCells::crowded_light(bool is_sample) {
  join_equal_cells();
  const std::vector<Row> all = rows();
  double most = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::int32_t y = all[r].begin->y;
    const bool has_row_above = r > 0 && all[r - 1].begin->y == y - 1;
    if (!has_row_above) most = light_of_rows({}, all[r], y - 1, is_sample, most);
    const bool has_row_below = r + 1 < all.size() && all[r + 1].begin->y == y + 1;
    most = light_of_rows(all[r], has_row_below ? all[r + 1] : Row{}, y, is_sample, most);
  }
  return most;
}

}  // namespace splotchcl
