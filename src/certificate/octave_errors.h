#pragma once

#include <cstddef>
#include <vector>

#include "certificate/cells.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Pixels x0 .. x1 - 1 in rows y0 .. y1 - 1 of the drawn picture.
struct PixelBlock {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

// The block of this number of BlockErrors, of which so many lie side by side.
inline PixelBlock pixels_of_block(std::size_t number, int columns) {
  constexpr int side = BlockErrors::block_pixels;
  const int x = static_cast<int>(number) % columns * side;
  const int y = static_cast<int>(number) / columns * side;
  return {x, x + side, y, y + side};
}

// Cells around a pixel whose splats may end there: all up to `reach` away, and one farther with
// what is left of the nearest of them.
struct EndingWindow {
  int reach = 0;
  double next_weight = 0, far_weight = 0;  // one cell farther, and all that are farther still
};

// What the approximations of one octave of splats on one grid do to a block of pixels, as errors
// of a sum of splats (light or optical depth). docs/dev/accuracy.md ("Checked after drawing")
// derives them.
class OctaveErrors {
 public:
  OctaveErrors(const PeakCells& cells, const Frame& frame, const FramePlan& plan);

  int octave() const { return octave_; }
  int level() const { return level_; }
  bool is_on_picture() const { return is_on_picture_; }

  // By ends of splats, beyond what even light leaves out; where a bound is asked for
  // (FramePlan::certify) in all. Where it is certain to be below `negligible`, a coarser bound.
  double of_ends(const PixelBlock& block, double negligible) const;
  // By errors that are parts of peaks and of one sign, where splats lie upon one another; where a
  // bound is asked for, of all splats that reach the block.
  double of_peaks(const PixelBlock& block, double negligible) const;
  // By which part of itself every splat errs at most, of so much light that lie upon one another;
  // infinite where that is not known, of splats that do not count as bright ones.
  double part_of_itself(double light) const;
  // As splats of so much light all of the octave are taken as means that keep their digits.
  double light_of_means() const { return light_of_means_; }
  // By places in single precision, whose roundings have either sign: what is passed once in 1e10.
  // Only where a bound is asked for.
  double of_places(const PixelBlock& block) const;
  // Which part of a peak.
  double peak_error() const { return peak_error_; }
  // The mean of the splats' light around the block.
  double light(const PixelBlock& block) const;
  // The part of even light that ends leave out at most, beside of_ends().
  double even_part() const { return is_bound_ ? 0 : lattice_rows * ending_; }

 private:
  CellRange cells_of(const PixelBlock& block, int side) const;
  double all_ends_around(const CellRange& cell) const;
  double ends_around(const CellRange& cell, double least) const;
  double even_around(const CellRange& cell) const;
  void find_inner_cells(const Frame& frame);
  double peaks_around(int x, int y) const;
  void find_uneven_peaks(const CellSums& peaks);
  double largest_of_peaks(const CellRange& here, const CellRange& squares, int y,
                          double least) const;

  bool is_bound_;
  int octave_, level_;
  bool is_on_picture_;
  int left_, top_;       // as in PeakCells
  int crop_x_, crop_y_;  // blocks count from the crop's corner
  int ending_side_, peak_side_;
  int light_cells_;       // over so many to each side light is averaged
  double light_of_cell_;  // the mean of a cell with one peak of 1
  double ending_, peak_error_;
  bool are_bright_means_;      // all splats of the octave
  double narrowest_, widest_;  // sigma, without the widening
  double light_of_means_;
  double place_error_, place_share_;  // parts of a peak; the most that one splat errs
  EndingWindow window_;
  CellRange inner_;  // cells of endings that hold no splats from beyond the picture
  std::vector<double> peak_weights_;  // of errors so many cells away, as an estimate
  int peak_reach_;  // cells from a pixel to the farthest splat whose errors show there
  BlockSums endings_, peaks_;
  // peaks_around() of all squares that hold a cell, from (-1, -1) on; none where a bound is asked
  // for. Blocks look at the same ones many times.
  std::vector<double> uneven_peaks_;
  int squares_across_ = 0, squares_along_ = 0;
  std::vector<double> most_uneven_of_rows_;  // the largest of each row of them
};

}  // namespace splotchcl
