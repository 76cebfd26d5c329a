#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace splotchcl {

struct CellSums {
  int side = 0;  // of a cell, in pixels of the grid
  int columns = 0, rows = 0;
  std::vector<float> values;
};

// Cells of an octave, by sigma in pixels of its grid, are as wide as its widest splats, 2^shift
// pixels: no wider than the smallest tile, and no narrower than two pixels for endings and four for
// peaks, so that together they take 3.5 bytes per pixel.
inline int cell_shift(int octave, int narrowest) {
  constexpr int widest = 4;
  return std::clamp(octave, narrowest, widest);
}
inline int ending_cell_shift(int octave) {
  return cell_shift(octave, 1);
}
inline int peak_cell_shift(int octave) {
  return cell_shift(octave, 2);
}

// Splats of one octave of widths on one grid of a drawn frame, in cells about as wide as they
// are. All splats that were drawn are in it, each once.
struct PeakCells {
  int level = 0;  // the grid's pixels are 2^level of the picture's wide
  // Of level 0: on the grids that are blurred, not on the picture's own.
  bool is_beside_picture = false;
  int left = 0, top = 0;  // of the cells, in pixels of the grid from the picture's corner
  int octave = 0;         // sigma in the picture's pixels: 2^(octave - 1) to twice that; 0: below 1
  // Of the splats' peaks: the largest channel of light or optical depth; below a pixel its flux.
  // Of bright splats on the picture's own grid only what a splat may be without being bright,
  // since the errors of bright ones are relative to what is there (docs/dev/accuracy.md).
  CellSums peaks;
  // What they have fallen to where they end, times exp(least extent^2 + farther).
  CellSums endings;

  bool is_on_picture() const { return level == 0 && !is_beside_picture; }
};

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

// Splats in square cells, to see where many lie upon one another.
class CrowdCells {
 public:
  // Cells are 2^shift pixels wide.
  explicit CrowdCells(int shift) : shift_(shift) {}

  // At a place in pixels.
  void add(double x, double y, double light);

  // The most light of two cells by two, beyond what an even field as full as those around them has
  // there. Of a sample, squares of few splats tell nothing, and others may be as full by chance.
  double crowded_light(bool is_sample);

 private:
  // Or several: their left and top one's place.
  struct Cell {
    std::int32_t x, y;
    double light, count;

    Cell& operator+=(const Cell& other) {
      light += other.light;
      count += other.count;
      return *this;
    }
  };
  struct Row {
    const Cell *begin = nullptr, *end = nullptr;
  };

  void join_equal_cells();
  std::vector<Row> rows() const;
  double light_within(std::int32_t left, std::int32_t top, std::int32_t side) const;
  // Or `least`, where it is less.
  double light_of_square(const Cell& square, bool is_sample, double least) const;
  double light_of_rows(const Row& upper, const Row& lower, std::int32_t top, bool is_sample,
                       double least) const;

  int shift_;
  std::vector<Cell> cells_;  // once joined, row by row
};

}  // namespace splotchcl
