#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "film/path_plot/path_plot.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr int cells = 24;  // a side

// The cube that holds the bulk of the particles, and how many of them its cells hold.
class Grid {
 public:
  explicit Grid(const std::vector<Vec3>& particles) : counts_(cells * cells * cells) {
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

  std::size_t count(const std::array<int, 3>& cell) const {
    const bool is_inside =
        std::all_of(cell.begin(), cell.end(), [](int i) { return i >= 0 && i < cells; });
    return is_inside ? counts_[index(cell)] : 0;
  }
  // Ties go to the first cell, so that there is one maximum of equal neighbours.
  bool is_peak(const std::array<int, 3>& cell) const {
    const std::size_t here = count(cell);
    if (here == 0) return false;
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> other = {cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1,
                                        cell[2] + n / 9 - 1};
      if (count(other) > here || (count(other) == here && n < 13)) return false;
    }
    return true;
  }
  DenseCell at(const std::array<int, 3>& cell) const {
    DenseCell result{corner_, size_};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result.center.a[axis] += (cell[axis] + 0.5) * size_;
    return result;
  }

 private:
  static std::size_t index(const std::array<int, 3>& cell) {
    return static_cast<std::size_t>((cell[2] * cells + cell[1]) * cells + cell[0]);
  }
  void add(const Vec3& particle) {
    std::array<int, 3> cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor((particle.a[axis] - corner_.a[axis]) / size_);
      if (!(place >= 0 && place < cells)) return;
      cell[axis] = static_cast<int>(place);
    }
    ++counts_[index(cell)];
  }

  Vec3 corner_ = {{0, 0, 0}};
  double size_ = 1;
  std::vector<std::size_t> counts_;
};

}  // namespace

std::vector<DenseCell> densest_cells(const std::vector<Vec3>& particles, std::size_t limit) {
  if (particles.empty()) return {};
  const Grid grid(particles);
  std::vector<std::array<int, 3>> peaks;
  for (int i = 0; i < cells * cells * cells; ++i) {
    const std::array<int, 3> cell = {i % cells, i / cells % cells, i / cells / cells};
    if (grid.is_peak(cell)) peaks.push_back(cell);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&grid](const auto& a, const auto& b) { return grid.count(a) > grid.count(b); });
  std::vector<DenseCell> result;
  for (std::size_t i = 0; i < std::min(limit, peaks.size()); ++i)
    result.push_back(grid.at(peaks[i]));
  return result;
}

}  // namespace splotchcl
