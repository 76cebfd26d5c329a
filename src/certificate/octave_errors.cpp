#include "certificate/octave_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "parallel/for_blocks.h"
#include "scene/plan/splat_limits.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

constexpr double pi = 3.141592653589793;

// Cells this many times as full as those around the pixel are not taken for even light.
constexpr double uneven = 2;
// Peaks of which four cells hold so much are opaque if they are even, and then their errors do not
// show.
constexpr double bright_square = 8;
// Errors of a peak on the picture's own grid show at most so many cells away.
constexpr int peak_spread = 2;
// The smallest cells are two pixels wide. A block at the picture's edge may reach beyond it, and
// what is looked at around a cell lies up to three more away.
constexpr int cells_in_block = BlockErrors::block_pixels / 2 + 3;
// Light is averaged over so many sigma to each side.
constexpr double light_reach = 1.5;

// Of the splats as they are drawn, and without the widening.
double widest_sigma(int octave) {
  return std::exp2(octave);
}

double narrowest_sigma(int octave) {
  return octave == 0 ? 0 : std::exp2(octave - 1);
}

double without_widening(double sigma, const FramePlan& plan) {
  return std::sqrt(std::max(0.0, sigma * sigma - static_cast<double>(plan.splats.widening)));
}

// In pixels of its grid.
double widest_sigma_on(int level, int octave) {
  return std::ldexp(widest_sigma(octave), -level);
}

double light_of(int octave, const FramePlan& plan) {
  return plan.needs.widths[static_cast<std::size_t>(octave)].light;
}

// The width below which splats of an octave are taken as means.
double widest_mean(int octave, const FramePlan& plan) {
  const auto mean_sigma = static_cast<double>(plan.splats.mean_sigma);
  const double light = light_of(octave, plan);
  return light > 0 ? std::max(mean_sigma, widest_bright_mean(plan.splats, light)) : mean_sigma;
}

// An octave tells nothing of the axes of an ellipse, of which each has its own width.
bool are_bright_means(int octave, const PeakCells& cells, const Frame& frame,
                      const FramePlan& plan) {
  return cells.is_on_picture() && light_of(octave, plan) > 0 && takes_pixel_means(frame) &&
         !plan.has_ellipses &&
         without_widening(widest_sigma(octave), plan) <= widest_mean(octave, plan);
}

// Means of bright splats keep their digits.
double error_of_means_in(int octave, double widest, const FramePlan& plan) {
  const double narrowest = without_widening(narrowest_sigma(octave), plan);
  return light_of(octave, plan) > 0 ? bright_mean_error(narrowest, widest)
                                    : widest * plan.mean_error;
}

// Errors of erf over both axes; and of the widened center value.
double error_of_peak(int octave, const PeakCells& cells, const Frame& frame,
                     const FramePlan& plan) {
  if (!cells.is_on_picture()) {
    const double of_filters = plan.grid_peak_error / plan.needs.grid_light;
    // A coarse grid softens the step at the edge of a cut disc.
    const double step = frame.kernel.cut ? std::exp(-*frame.kernel.cut * *frame.kernel.cut) : 0;
    return of_filters + step;
  }
  if (!takes_pixel_means(frame)) return 0;
  const double narrowest = without_widening(narrowest_sigma(octave), plan);
  const double widest = without_widening(widest_sigma(octave), plan);
  const double mean = widest_mean(octave, plan);
  double error = 0;
  if (narrowest < mean) error = error_of_means_in(octave, std::min(widest, mean), plan);
  if (widest > mean) error = std::max(error, center_value_error(std::max(narrowest, mean)));
  return error / std::max(1.0, light_of(octave, plan));
}

// 0.86 of a peak for each sigma by which a splat is off (docs/dev/accuracy.md, "Single precision").
double place_error_of(int octave, const Frame& frame, const FramePlan& plan) {
  const double farthest = 0.5 * std::max(frame.width, frame.height);
  const double roundings = static_cast<double>(plan.places.error) +
                           static_cast<double>(plan.places.error_per_pixel) * farthest;
  return 0.86 * 0x1p-24 * roundings / std::max(0.5, narrowest_sigma(octave));
}

// From which on all splats of an octave are taken as means. Nothing does that for ellipses, of
// which an axis may be as wide as one likes.
double light_that_makes_means(int octave, const FramePlan& plan) {
  if (plan.has_ellipses || plan.splats.bright_mean_sigma <= 0)
    return std::numeric_limits<double>::infinity();
  return light_of_bright_means(plan.splats, without_widening(widest_sigma(octave), plan));
}

// What is left of a splat where it ends. A cut is part of the model.
double ending_of(int octave, const Frame& frame, const FramePlan& plan) {
  return frame.kernel.cut ? 0 : std::exp(-least_extent2(plan, octave));
}

// So many cells around any cell that a block may look at are all that there are.
int reach_of_all(const CellSums& cells) {
  return std::max(cells.columns, cells.rows) + cells_in_block;
}

EndingWindow window_of(int octave, int level, const CellSums& cells, const FramePlan& plan) {
  const int side = cells.side, all = reach_of_all(cells);
  const double sigma = std::ldexp(widest_sigma(octave), -level);
  const double radius = std::sqrt(least_extent2(plan, octave)) * sigma + 0.5;
  EndingWindow window;
  if (radius > static_cast<double>(all) * side) {
    window.reach = all;
    return window;
  }
  window.reach = static_cast<int>(std::ceil(radius / side));
  const auto left_at = [&](double distance) {
    return std::exp((radius * radius - distance * distance) / (sigma * sigma));
  };
  window.next_weight = left_at(window.reach * side);
  window.far_weight = left_at((window.reach + 1) * side);
  return window;
}

// Cells are about as wide as their splats' sigma.
int peak_spread_of(const PeakCells& cells, const Frame& frame) {
  if (cells.is_on_picture() || !frame.kernel.cut) return peak_spread;
  return std::max(peak_spread, static_cast<int>(std::ceil(*frame.kernel.cut)) + 1);
}

// Where a splat is drawn, and as far as a coarse grid's filters carry it: what they reach of each
// grid, whose pixels are half as wide as those of the one before.
int peak_reach_of(int octave, const PeakCells& cells, const FramePlan& plan) {
  const double filter_pixels = 2 * RefinementFilter::reach();
  const double sigma = std::ldexp(widest_sigma(octave), -cells.level);
  const double reach =
      std::sqrt(least_extent2(plan, octave)) * sigma + (cells.is_on_picture() ? 1 : filter_pixels);
  return static_cast<int>(
      std::min<double>(std::ceil(reach / cells.peaks.side), reach_of_all(cells.peaks)));
}

// As an estimate, what is left of an error of a peak so many cells away. Those of erf in full
// precision do not fade along the axes. Coarse grids err by values that their filters take from
// pixels nearer.
std::vector<double> peak_weights_of(int octave, const PeakCells& cells, const Frame& frame,
                                    const FramePlan& plan) {
  const double filter_pixels = RefinementFilter::reach();
  const int spread = peak_spread_of(cells, frame);
  if (cells.is_on_picture() && plan.precision != Precision::full)
    return std::vector<double>(static_cast<std::size_t>(spread) + 1, 1.0);
  const double sigma = std::ldexp(widest_sigma(octave), -cells.level);
  const int reach = std::max(spread, peak_reach_of(octave, cells, plan));
  std::vector<double> weights(static_cast<std::size_t>(reach) + 1, 1.0);
  for (int away = spread + 1; !cells.is_on_picture() && away <= reach; ++away) {
    const double nearest = std::max(0.0, ((away - 1) * cells.peaks.side - filter_pixels) / sigma);
    weights[static_cast<std::size_t>(away)] = std::exp(-nearest * nearest);
  }
  return weights;
}

// Of values that are not negative. Four at a time: each of a single row would wait for the last.
double largest_of(const double* begin, const double* end) {
  std::array<double, 4> largest{};
  for (; end - begin >= 4; begin += 4) {
    for (std::size_t i = 0; i < largest.size(); ++i)
      largest[i] = std::max(largest[i], begin[i]);
  }
  for (; begin < end; ++begin)
    largest[0] = std::max(largest[0], *begin);
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace

OctaveErrors::OctaveErrors(const PeakCells& cells, const Frame& frame, const FramePlan& plan)
    : is_bound_(plan.certify),
      octave_(std::min(cells.octave, width_octaves - 1)),
      level_(cells.level),
      is_on_picture_(cells.is_on_picture()),
      left_(cells.left),
      top_(cells.top),
      crop_x_(frame.crop.x),
      crop_y_(frame.crop.y),
      ending_side_(cells.endings.side),
      peak_side_(cells.peaks.side),
      light_cells_(
          static_cast<int>(std::ceil(light_reach * widest_sigma_on(level_, octave_) / peak_side_))),
      light_of_cell_(pi * std::pow(widest_sigma_on(level_, octave_) / peak_side_, 2)),
      ending_(ending_of(octave_, frame, plan)),
      peak_error_(error_of_peak(octave_, cells, frame, plan)),
      are_bright_means_(are_bright_means(octave_, cells, frame, plan)),
      narrowest_(without_widening(narrowest_sigma(octave_), plan)),
      widest_(without_widening(widest_sigma(octave_), plan)),
      light_of_means_(light_that_makes_means(octave_, plan)),
      place_error_(place_error_of(octave_, frame, plan)),
      place_share_(plan.places.share),
      window_(window_of(octave_, level_, cells.endings, plan)),
      peak_weights_(peak_weights_of(octave_, cells, frame, plan)),
      peak_reach_(is_bound_ ? peak_reach_of(octave_, cells, plan)
                            : static_cast<int>(peak_weights_.size()) - 1),
      endings_(cells.endings, window_.reach + cells_in_block),
      peaks_(cells.peaks, peak_reach_ + cells_in_block) {
  find_inner_cells(frame);
  if (!is_bound_) find_uneven_peaks(cells.peaks);
}

void OctaveErrors::find_uneven_peaks(const CellSums& peaks) {
  constexpr std::size_t rows_at_once = 16;
  squares_across_ = peaks.columns + 1;
  squares_along_ = peaks.rows + 1;
  const auto across = static_cast<std::size_t>(squares_across_);
  const auto along = static_cast<std::size_t>(squares_along_);
  uneven_peaks_.resize(across * along);
  most_uneven_of_rows_.resize(along);
  for_blocks(along, rows_at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y) {
      for (std::size_t x = 0; x < across; ++x)
        uneven_peaks_[y * across + x] =
            peaks_around(static_cast<int>(x) - 1, static_cast<int>(y) - 1);
      const double* const row = uneven_peaks_.data() + y * across;
      most_uneven_of_rows_[y] = largest_of(row, row + across);
    }
  });
}

// Splats beyond the picture are collected in the cells at its edge.
void OctaveErrors::find_inner_cells(const Frame& frame) {
  const CellRange picture = cells_of({0, frame.crop.width, 0, frame.crop.height}, ending_side_);
  inner_ = picture.widened(-1);
}

CellRange OctaveErrors::cells_of(const PixelBlock& block, int side) const {
  // Both are whole numbers of pixels of the grid or of the picture: shifts round down.
  const auto column = [&](int x) { return (((x + crop_x_) >> level_) - left_) / side; };
  const auto row = [&](int y) { return (((y + crop_y_) >> level_) - top_) / side; };
  return {column(block.x0), column(block.x1 - 1) + 1, row(block.y0), row(block.y1 - 1) + 1};
}

double OctaveErrors::all_ends_around(const CellRange& cell) const {
  const double within = endings_.over_near(cell.widened(window_.reach));
  const double next = endings_.over_near(cell.widened(window_.reach + 1)) - within;
  return within + window_.next_weight * next;
}

// Or `least`, where it is less.
double OctaveErrors::ends_around(const CellRange& cell, double least) const {
  const double all = all_ends_around(cell);
  if (is_bound_) return std::max(least, all + window_.far_weight * endings_.total());
  if (all <= least) return least;
  const double cells = (2.0 * window_.reach + 1) * (2.0 * window_.reach + 1);
  return std::max(least, all - uneven * cells * even_around(cell));
}

// Of the four squares of two cells by two that the cell lies in, or inner ones next to it, the
// emptiest: a cluster or a line beside the cell is no even light. So there are two squares along
// each axis everywhere, and where there is no room for two nothing is known to be even. Beside the
// inner cells the nearest of them is the emptiest that may be.
double OctaveErrors::even_around(const CellRange& cell) const {
  if (inner_.x1 - inner_.x0 < 3 || inner_.y1 - inner_.y0 < 3) return 0;
  const int left = std::clamp(cell.x0 - 1, inner_.x0, inner_.x1 - 3);
  const int top = std::clamp(cell.y0 - 1, inner_.y0, inner_.y1 - 3);
  double least = std::numeric_limits<double>::max();
  for (const int x : {left, left + 1}) {
    for (const int y : {top, top + 1})
      least = std::min(least, endings_.over_near({x, x + 2, y, y + 2}) / 4);
  }
  const int x = std::clamp(cell.x0, inner_.x0, inner_.x1 - 1);
  const int y = std::clamp(cell.y0, inner_.y0, inner_.y1 - 1);
  if (x != cell.x0 || y != cell.y0)
    least = std::min(least, endings_.over_near({x, x + 1, y, y + 1}));
  return least;
}

double OctaveErrors::of_ends(const PixelBlock& block, double negligible) const {
  const CellRange range = cells_of(block, ending_side_);
  const double farther = is_bound_ ? window_.far_weight * endings_.total() : 0;
  const double most = ending_ * (endings_.over_near(range.widened(window_.reach + 1)) + farther);
  if (most <= negligible) return most;
  double largest = 0;
  for (int y = range.y0; y < range.y1; ++y) {
    for (int x = range.x0; x < range.x1; ++x)
      largest = ends_around({x, x + 1, y, y + 1}, largest);
  }
  return ending_ * largest;
}

// Two cells by two, beyond what an even field as full as their surroundings has there.
double OctaveErrors::peaks_around(int x, int y) const {
  const CellRange square = {x, x + 2, y, y + 2};
  const double here = peaks_.over_near(square);
  const double around = peaks_.over_near(square.widened(2)) - here;
  // Crowds in regular places look even to the cells; where they are bright, it shows between them.
  const double not_even = here > bright_square ? 1 : uneven;
  return std::max(0.0, here - not_even * 4 * around / 32);
}

double OctaveErrors::of_peaks(const PixelBlock& block, double negligible) const {
  const CellRange range = cells_of(block, peak_side_).widened(peak_reach_);
  if (is_bound_) return peak_error_ * peaks_.over_near(range);
  const double most = peak_error_ * peaks_.over_near(range.widened(1));
  if (most <= negligible) return most;
  const CellRange here = cells_of(block, peak_side_);
  const CellRange squares = {std::max(range.x0 - 1, -1), std::min(range.x1, squares_across_ - 1),
                             std::max(range.y0 - 1, -1), std::min(range.y1, squares_along_ - 1)};
  if (squares.x0 >= squares.x1 || squares.y0 >= squares.y1) return 0;
  // Rows of the block first: where these have much, little that is farther away is looked at.
  const int first = std::clamp(here.y0 - 1, squares.y0, squares.y1);
  double largest = 0;
  for (int y = first; y < squares.y1; ++y)
    largest = largest_of_peaks(here, squares, y, largest);
  for (int y = first - 1; y >= squares.y0; --y)
    largest = largest_of_peaks(here, squares, y, largest);
  return peak_error_ * largest;
}

// In a row of squares, faded by how far they are from the block's cells; or `least`, where that is
// less.
double OctaveErrors::largest_of_peaks(const CellRange& here, const CellRange& squares, int y,
                                      double least) const {
  const auto weight = [&](int rows, int columns) {
    return peak_weights_[static_cast<std::size_t>(std::max(rows, columns))];
  };
  const int rows = std::max({0, here.y0 - y - 1, y - here.y1 + 1});
  const double most = most_uneven_of_rows_[static_cast<std::size_t>(y + 1)];
  if (weight(rows, 0) * most <= least) return least;
  // Squares that hold a cell of the block's columns, and those so many cells to either side.
  const bool fades = peak_weights_.back() < 1;
  const int first = fades ? here.x0 - 1 : squares.x0, end = fades ? here.x1 : squares.x1;
  const int left = std::clamp(first, squares.x0, squares.x1);
  const int right = std::clamp(end, left, squares.x1);
  const double* const uneven = uneven_peaks_.data() + std::ptrdiff_t{y + 1} * squares_across_ + 1;
  double largest = std::max(least, weight(rows, 0) * largest_of(uneven + left, uneven + right));
  for (int x = left - 1; x >= squares.x0 && weight(rows, first - x) * most > largest; --x)
    largest = std::max(largest, weight(rows, first - x) * uneven[x]);
  for (int x = right; x < squares.x1 && weight(rows, x - end + 1) * most > largest; ++x)
    largest = std::max(largest, weight(rows, x - end + 1) * uneven[x]);
  return largest;
}

double OctaveErrors::part_of_itself(double light) const {
  if (!are_bright_means_) return std::numeric_limits<double>::infinity();
  return part_of_bright_mean(narrowest_, widest_, light);
}

double OctaveErrors::of_places(const PixelBlock& block) const {
  // Bounds are at least four standard deviations (docs/dev/accuracy.md).
  constexpr double bounds = 6.5 / 4;
  const double light = peaks_.over_near(cells_of(block, peak_side_).widened(peak_reach_));
  return bounds * std::sqrt(place_share_ * place_error_ * light);
}

double OctaveErrors::light(const PixelBlock& block) const {
  const CellRange range = cells_of(block, peak_side_).widened(light_cells_);
  const double cells = static_cast<double>(range.x1 - range.x0) * (range.y1 - range.y0);
  return peaks_.over(range) * light_of_cell_ / cells;
}

}  // namespace splotchcl
