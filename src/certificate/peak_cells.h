#pragma once

#include <algorithm>
#include <vector>

namespace splotchcl {

// Sums over square cells, row by row.
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

}  // namespace splotchcl
