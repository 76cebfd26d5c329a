#include "map/expected_least.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr int cells_along = 64;
constexpr std::size_t enough = 1u << 20;  // particles
// Clouds beside the picture count up to so many of their cells away.
constexpr int guard = 2;
// Of the weights, and of the values' sizes.
using Pair = std::array<double, 2>;

// Square cells around the picture's middle, as wide as the widest of their clouds.
class CellGrid {
 public:
  CellGrid(double cell, const SumPicture& picture)
      : cell_(cell),
        columns_(static_cast<int>(std::ceil(picture.width / cell)) + 2 * guard),
        rows_(static_cast<int>(std::ceil(picture.height / cell)) + 2 * guard),
        left_(-0.5 * picture.width - guard * cell),
        top_(-0.5 * picture.height - guard * cell),
        sums_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(double x, double y, const Pair& sums) {
    const double column = (x - left_) / cell_, row = (y - top_) / cell_;
    if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return;
    Pair& at = this->at(static_cast<int>(column), static_cast<int>(row));
    for (std::size_t s = 0; s < at.size(); ++s)
      at[s] += sums[s];
  }

  // About what clouds as wide as a cell give a pixel here: a cell's weights are spread over nine.
  Pair per_pixel(double x, double y) const {
    constexpr std::array<double, 3> spread = {0.25, 0.5, 0.25};
    const int column = clamped((x - left_) / cell_, columns_);
    const int row = clamped((y - top_) / cell_, rows_);
    Pair sums = {0, 0};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double part = spread[static_cast<std::size_t>(i)] *
                            spread[static_cast<std::size_t>(j)] / (cell_ * cell_);
        const Pair& near = at(column + j - 1, row + i - 1);
        for (std::size_t s = 0; s < sums.size(); ++s)
          sums[s] += part * near[s];
      }
    }
    return sums;
  }

 private:
  // With a neighbor on each side.
  static int clamped(double place, int count) {
    return std::clamp(static_cast<int>(place), 1, count - 2);
  }
  std::size_t place_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Pair& at(int column, int row) { return sums_[place_of(column, row)]; }
  const Pair& at(int column, int row) const { return sums_[place_of(column, row)]; }

  double cell_;
  int columns_, rows_;
  double left_, top_;
  std::vector<Pair> sums_;
};

class CoarseSums {
 public:
  explicit CoarseSums(const SumPicture& picture)
      : picture_(picture), side_(std::max(picture.width, picture.height)) {
    cell_ = std::max(1.0, side_ / cells_along);
    for (double cell = cell_; grids_.empty() || cell < 2 * side_; cell *= 2)
      grids_.emplace_back(cell, picture);
  }

  void add(double x, double y, double sigma, const Pair& sums) {
    const double octaves = sigma > cell_ ? std::ceil(std::log2(sigma / cell_)) : 0;
    if (octaves < static_cast<double>(grids_.size())) {
      grids_[static_cast<std::size_t>(octaves)].add(x, y, sums);
      return;
    }
    // So wide that it gives all pixels about the same.
    const double part = std::exp(-(x * x + y * y) / (sigma * sigma)) / (pi * sigma * sigma);
    for (std::size_t s = 0; s < even_.size(); ++s)
      even_[s] += part * sums[s];
  }

  // Of pixels in the middle of cells.
  Pair least() const {
    Pair least = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    for (double y = 0.5 * (cell_ - picture_.height); y < 0.5 * picture_.height; y += cell_) {
      for (double x = 0.5 * (cell_ - picture_.width); x < 0.5 * picture_.width; x += cell_) {
        Pair here = even_;
        for (const CellGrid& grid : grids_) {
          const Pair of_grid = grid.per_pixel(x, y);
          for (std::size_t s = 0; s < here.size(); ++s)
            here[s] += of_grid[s];
        }
        for (std::size_t s = 0; s < here.size(); ++s)
          least[s] = std::min(least[s], here[s]);
      }
    }
    return least;
  }

 private:
  SumPicture picture_;
  double side_, cell_ = 1;
  std::vector<CellGrid> grids_;  // each of cells twice as wide as the one before
  Pair even_ = {0, 0};
};

}  // namespace

double expected_least_sum(const PlacedParticles& placed, const std::vector<float>& size,
                          const SumRequest& request, const SumPicture& picture) {
  CoarseSums sums(picture);
  const bool has_factors = !request.factors.empty();
  const std::size_t step = std::max<std::size_t>(1, placed.count() / enough);
  for (std::size_t i = 0; i < placed.count(); i += step) {
    const double weight = static_cast<double>(step) * static_cast<double>(request.weight[i]);
    Pair of_cloud = {weight, weight};
    if (has_factors) {
      of_cloud[0] *= static_cast<double>(request.factors[3 * i]);
      of_cloud[1] *= static_cast<double>(request.factors[3 * i + 1]) +
                     static_cast<double>(request.factors[3 * i + 2]);
    }
    sums.add(static_cast<double>(placed.position[3 * i]),
             static_cast<double>(placed.position[3 * i + 1]),
             picture.kernel_width * static_cast<double>(size[i]), of_cloud);
  }
  const Pair least = sums.least();
  return std::min(least[0], least[1]);
}

}  // namespace splotchcl
