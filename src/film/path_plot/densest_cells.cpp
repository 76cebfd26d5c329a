#include <algorithm>
#include <array>
#include <boost/qvm/operations.hpp>
#include <cmath>
#include <cstddef>

#include "film/path_plot/path_plot.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr int cells = 24;   // a side
constexpr int around = 27;  // a cell and its neighbours
constexpr int itself = 13;  // of those the middle one

// Of the densest cell's particles. Wherever there are a few, chance makes peaks of them; groups of
// a hundredth of a cluster's mass are still worth a circle.
constexpr double least_part = 0.01;

using Cell = std::array<int, 3>;

Cell neighbor(const Cell& cell, int n) {
  return {cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
}

// The cube that holds the bulk of the particles, how many of them its cells hold, and where.
class Grid {
 public:
  explicit Grid(const std::vector<Vec3>& particles)
      : counts_(cells * cells * cells), sums_(counts_.size(), Vec3{{0, 0, 0}}) {
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& particle : particles)
        values.push_back(particle.a[axis]);
      const double low = percentile(values, 0.005), high = percentile(values, 0.995);
      corner_.a[axis] = 0.5 * (low + high);
      side = std::max(side, high - low);
    }
    size_ = side > 0 ? side / cells : 1;
    for (double& edge : corner_.a)
      edge -= 0.5 * cells * size_;
    for (const Vec3& particle : particles)
      add(particle);
  }

  std::size_t count(const Cell& cell) const { return is_inside(cell) ? counts_[index(cell)] : 0; }
  // Ties go to the first cell, so that there is one maximum of equal neighbours.
  bool is_peak(const Cell& cell) const {
    const std::size_t here = count(cell);
    if (here == 0) return false;
    for (int n = 0; n < around; ++n) {
      const std::size_t there = count(neighbor(cell, n));
      if (there > here || (there == here && n < itself)) return false;
    }
    return true;
  }
  // Edges of cells cut through crowds: the middle of one is where its particles are in the mean.
  DenseCell around_peak(const Cell& peak) const {
    using namespace boost::qvm;
    Vec3 sum = {{0, 0, 0}};
    std::size_t particles = 0;
    for (int n = 0; n < around; ++n) {
      const Cell cell = neighbor(peak, n);
      if (!is_inside(cell)) continue;
      sum += sums_[index(cell)];
      particles += counts_[index(cell)];
    }
    return {corner_ + sum / static_cast<double>(particles), size_};
  }

 private:
  static bool is_inside(const Cell& cell) {
    return std::all_of(cell.begin(), cell.end(), [](int i) { return i >= 0 && i < cells; });
  }
  static std::size_t index(const Cell& cell) {
    return static_cast<std::size_t>((cell[2] * cells + cell[1]) * cells + cell[0]);
  }
  void add(const Vec3& particle) {
    using namespace boost::qvm;
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor((particle.a[axis] - corner_.a[axis]) / size_);
      if (!(place >= 0 && place < cells)) return;
      cell[axis] = static_cast<int>(place);
    }
    ++counts_[index(cell)];
    sums_[index(cell)] += particle - corner_;
  }

  Vec3 corner_ = {{0, 0, 0}};
  double size_ = 1;
  std::vector<std::size_t> counts_;
  std::vector<Vec3> sums_;  // of places from the corner
};

}  // namespace

std::vector<DenseCell> densest_cells(const std::vector<Vec3>& particles, std::size_t limit) {
  if (particles.empty()) return {};
  const Grid grid(particles);
  std::vector<Cell> peaks;
  for (int i = 0; i < cells * cells * cells; ++i) {
    const Cell cell = {i % cells, i / cells % cells, i / cells / cells};
    if (grid.is_peak(cell)) peaks.push_back(cell);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&grid](const auto& a, const auto& b) { return grid.count(a) > grid.count(b); });
  std::vector<DenseCell> result;
  for (std::size_t i = 0; i < std::min(limit, peaks.size()); ++i) {
    const auto count = static_cast<double>(grid.count(peaks[i]));
    if (count < least_part * static_cast<double>(grid.count(peaks[0]))) break;
    result.push_back(grid.around_peak(peaks[i]));
  }
  return result;
}

}  // namespace splotchcl
