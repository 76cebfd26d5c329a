#include "tree/error_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splotchcl {
namespace {

int halved(int cells) {
  return (cells + 1) / 2;
}

}  // namespace

ErrorCells::ErrorCells(int width, int height) {
  int columns = (width + cell_pixels - 1) / cell_pixels;
  int rows = (height + cell_pixels - 1) / cell_pixels;
  while (true) {
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    const double pixels = std::ldexp(static_cast<double>(cell_pixels), scales());
    grids_.push_back({columns, rows, pixels, std::vector<double>(cells, 0)});
    if (columns == 1 && rows == 1) break;
    columns = halved(columns);
    rows = halved(rows);
  }
}

int ErrorCells::scale_of(double pixels) const {
  if (!(pixels > cell_pixels)) return 0;
  return std::min(scales() - 1, static_cast<int>(std::ceil(std::log2(pixels / cell_pixels))));
}

std::size_t ErrorCells::cell_at(int scale, double x, double y) const {
  const Grid& cells = grid(scale);
  const auto place = [&](double at, int count) {
    return static_cast<std::size_t>(
        std::clamp(at / cells.pixels, 0.0, static_cast<double>(count - 1)));
  };
  return place(y, cells.rows) * static_cast<std::size_t>(cells.columns) + place(x, cells.columns);
}

std::size_t ErrorCells::parent(int scale, std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(grid(scale).columns);
  const auto wider = static_cast<std::size_t>(grid(scale + 1).columns);
  return cell / columns / 2 * wider + cell % columns / 2;
}

void ErrorCells::add(const ErrorCells& others) {
  for (std::size_t s = 0; s < grids_.size(); ++s) {
    for (std::size_t cell = 0; cell < grids_[s].values.size(); ++cell)
      grids_[s].values[cell] += others.grids_[s].values[cell];
  }
}

CellNumbers ErrorCells::totals_with(bool of_largest) const {
  CellNumbers within(grids_.size()), around(grids_.size());
  for (std::size_t s = 0; s < grids_.size(); ++s) {
    const double none = of_largest ? 0 : std::numeric_limits<double>::infinity();
    within[s].assign(grids_[s].values.size(), s == 0 ? 0 : none);
    around[s].assign(grids_[s].values.size(), 0);
    if (s == 0) continue;
    for (std::size_t cell = 0; cell < grids_[s - 1].values.size(); ++cell) {
      double& sum = within[s][parent(static_cast<int>(s) - 1, cell)];
      const double own = within[s - 1][cell] + grids_[s - 1].values[cell];
      sum = of_largest ? std::max(sum, own) : std::min(sum, own);
    }
  }
  for (std::size_t s = grids_.size() - 1; s-- > 0;) {
    for (std::size_t cell = 0; cell < grids_[s].values.size(); ++cell) {
      const std::size_t wider = parent(static_cast<int>(s), cell);
      around[s][cell] = around[s + 1][wider] + grids_[s + 1].values[wider];
    }
  }
  for (std::size_t s = 0; s < grids_.size(); ++s) {
    for (std::size_t cell = 0; cell < grids_[s].values.size(); ++cell)
      within[s][cell] += around[s][cell] + grids_[s].values[cell];
  }
  return within;
}

CellNumbers ErrorCells::totals() const {
  return totals_with(true);
}

CellNumbers ErrorCells::least_totals() const {
  return totals_with(false);
}

}  // namespace splotchcl
