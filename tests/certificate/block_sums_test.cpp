#include "certificate/block_sums.h"

#include <gtest/gtest.h>

#include <vector>

namespace splotchcl {
namespace {

// Cell (x, y) holds 1 + x + 10 y.
CellSums numbered(int columns, int rows) {
  CellSums cells;
  cells.side = 2;
  cells.columns = columns;
  cells.rows = rows;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x)
      cells.values.push_back(static_cast<float>(1 + x + 10 * y));
  }
  return cells;
}

double added_up(const CellSums& cells, const CellRange& range) {
  double sum = 0;
  for (int y = range.y0; y < range.y1; ++y) {
    for (int x = range.x0; x < range.x1; ++x) {
      const bool exists = x >= 0 && x < cells.columns && y >= 0 && y < cells.rows;
      if (exists)
        sum += static_cast<double>(cells.values[static_cast<std::size_t>(y * cells.columns + x)]);
    }
  }
  return sum;
}

TEST(BlockSums, AddUpEveryRectangleInAndAroundTheCells) {
  const CellSums cells = numbered(5, 3);
  const int margin = 2;
  const BlockSums sums(cells, margin);
  for (int x0 = -margin; x0 <= 5 + margin; ++x0) {
    for (int x1 = x0; x1 <= 5 + margin; ++x1) {
      for (int y0 = -margin; y0 <= 3 + margin; ++y0) {
        for (int y1 = y0; y1 <= 3 + margin; ++y1) {
          const CellRange range = {x0, x1, y0, y1};
          ASSERT_EQ(sums.over_near(range), added_up(cells, range));
          ASSERT_EQ(sums.over(range), added_up(cells, range));
        }
      }
    }
  }
}

TEST(BlockSums, AreEmptyFarFromTheCells) {
  const CellSums cells = numbered(5, 3);
  const BlockSums sums(cells, 1);
  EXPECT_EQ(sums.over({-100, 200, -50, 70}), added_up(cells, {0, 5, 0, 3}));
  EXPECT_EQ(sums.over({20, 30, 0, 3}), 0);
}

}  // namespace
}  // namespace splotchcl
