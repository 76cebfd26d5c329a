#pragma once

#include <cstddef>
#include <vector>

namespace splotchcl {

// A number for each cell of each scale.
using CellNumbers = std::vector<std::vector<double>>;

// Sums over square cells of a picture, of which nodes count in one about as large as they are
// drawn: cells of scale 0 have cell_pixels on each side, those of the next scale twice as many.
class ErrorCells {
 public:
  static constexpr int cell_pixels = 4;

  ErrorCells(int width, int height);

  int scales() const { return static_cast<int>(grids_.size()); }
  // The scale for a node that is so many pixels wide.
  int scale_of(double pixels) const;
  // The cell that a place lies in, the nearest one beside the picture.
  std::size_t cell_at(int scale, double x, double y) const;
  // The cell of the next scale around one.
  std::size_t parent(int scale, std::size_t cell) const;
  std::size_t count(int scale) const { return grid(scale).values.size(); }
  double pixels(int scale) const { return grid(scale).pixels; }  // on each side
  int columns(int scale) const { return grid(scale).columns; }

  double& at(int scale, std::size_t cell) { return grid(scale).values[cell]; }
  double at(int scale, std::size_t cell) const { return grid(scale).values[cell]; }

  // Those of others over the same picture.
  void add(const ErrorCells& others);

  // Of each cell: its own value, those of all larger cells around it, and the largest sum of
  // smaller ones within it.
  CellNumbers totals() const;
  // The same with the smallest sum of smaller ones.
  CellNumbers least_totals() const;

 private:
  struct Grid {
    int columns = 0, rows = 0;
    double pixels = cell_pixels;
    std::vector<double> values;
  };
  Grid& grid(int scale) { return grids_[static_cast<std::size_t>(scale)]; }
  const Grid& grid(int scale) const { return grids_[static_cast<std::size_t>(scale)]; }
  CellNumbers totals_with(bool of_largest) const;

  std::vector<Grid> grids_;
};

}  // namespace splotchcl
