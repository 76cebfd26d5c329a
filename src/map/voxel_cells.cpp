#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "cells/gaussian.h"
#include "map/cell_map.h"
#include "parallel/for_blocks.h"
#include "splotchcl/periodic.h"

namespace splotchcl {
namespace {

using Grid = std::array<CellsAlongAxis, 3>;

Grid grid_of(const CellMatter& matter) {
  const MapGeometry& geometry = matter.geometry;
  Grid grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int count = matter.settings.voxels[axis];
    const double first = geometry.center.a[axis] - 0.5 * count * geometry.pixel;
    grid[axis] = {first, geometry.pixel, count, std::nullopt};
    if (geometry.box) grid[axis].period = (*geometry.box)[axis];
  }
  return grid;
}

// The sums of planes with z from `first` on, one after the other, of all particles.
class Slab {
 public:
  Slab(const CellMatter& matter, const Amounts& amounts, const Grid& grid, int first, int last,
       CellSums& sums)
      : matter_(matter),
        amounts_(amounts),
        grid_(grid),
        slab_(grid[2]),
        sums_(sums),
        first_(first) {
    slab_.first += first * slab_.width;
    slab_.count = last - first;
  }

  void add(std::size_t i) {
    const double sigma = matter_.sigma * matter_.matter.size_of(i);
    const Vec3 place = matter_.matter.position_of(i);
    if (!can_reach(place.a[2], sigma)) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      find_shares_along_axis(axis == 2 ? slab_ : grid_[axis], place.a[axis], sigma, rows_[axis]);
      if (rows_[axis].empty()) return;
    }
    for (std::size_t kind = 0; kind < amounts_.kinds(); ++kind)
      add_amount(amounts_(i, kind), sums_.kinds[kind]);
  }

 private:
  bool can_reach(double z, double sigma) const {
    const double half = 0.5 * slab_.count * slab_.width;
    double away = z - (slab_.first + half);
    if (slab_.period) away = nearest_image(away, *slab_.period);
    return std::abs(away) <= half + kernel_reach * sigma;
  }

  void add_amount(double amount, std::vector<double>& sums) const {
    if (amount == 0) return;
    for (const SharesAlongAxis& z : rows_[2]) {
      for (std::size_t k = 0; k < z.parts.size(); ++k) {
        const auto plane = static_cast<std::size_t>(first_ + z.first) + k;
        for (const SharesAlongAxis& y : rows_[1]) {
          for (std::size_t j = 0; j < y.parts.size(); ++j)
            add_row(amount * z.parts[k] * y.parts[j], plane, static_cast<std::size_t>(y.first) + j,
                    sums);
        }
      }
    }
  }

  // Rows of maps begin at the top.
  void add_row(double amount, std::size_t plane, std::size_t row, std::vector<double>& sums) const {
    if (amount == 0) return;
    const auto width = static_cast<std::size_t>(grid_[0].count),
               height = static_cast<std::size_t>(grid_[1].count);
    double* const first = sums.data() + (plane * height + height - 1 - row) * width;
    for (const SharesAlongAxis& x : rows_[0]) {
      double* const cells = first + x.first;
      for (std::size_t i = 0; i < x.parts.size(); ++i)
        cells[i] += amount * x.parts[i];
    }
  }

  const CellMatter& matter_;
  const Amounts& amounts_;
  const Grid& grid_;
  CellsAlongAxis slab_;
  CellSums& sums_;
  int first_;
  std::array<std::vector<SharesAlongAxis>, 3> rows_;
};

// In slabs, each with all particles in their order.
void add_up(const CellMatter& matter, const Amounts& amounts, const Grid& grid, CellSums& sums) {
  constexpr std::size_t slabs = 16;
  const auto planes = static_cast<std::size_t>(grid[2].count);
  const std::size_t thickness = (planes + slabs - 1) / slabs;
  for_blocks(
      planes, thickness,
      [&](std::size_t first, std::size_t last) {
        Slab slab(matter, amounts, grid, static_cast<int>(first), static_cast<int>(last), sums);
        for (std::size_t i = 0; i < matter.matter.count; ++i) {
          if (amounts.is_good(i)) slab.add(i);
        }
      },
      matter.progress);
}

void check_reach(const CellMatter& matter, const Amounts& amounts) {
  double largest = 0;
  for (std::size_t i = 0; i < matter.matter.count; ++i) {
    if (amounts.is_good(i)) largest = std::max(largest, matter.matter.size_of(i));
  }
  check_images(kernel_reach * matter.sigma * largest, matter.geometry.box,
               fmt::format("a smoothing length of {:.6g}", largest));
}

}  // namespace

CellMap draw_voxels(const CellMatter& matter) {
  const auto& voxels = matter.settings.voxels;
  const Amounts amounts(matter.quantity, matter.matter.count, matter.weight_unit,
                        [&](std::size_t i) { return matter.matter.is_good(i); });
  const double count = static_cast<double>(voxels[0]) * voxels[1] * voxels[2];
  check_cells(count, amounts.kinds(),
              fmt::format("key map.voxels: {} x {} x {}", voxels[0], voxels[1], voxels[2]));
  check_reach(matter, amounts);
  const Grid grid = grid_of(matter);
  CellSums sums(amounts.kinds(), static_cast<std::size_t>(count));
  add_up(matter, amounts, grid, sums);

  CellMap map;
  const double volume = std::pow(matter.geometry.pixel, 3);
  double inside = 0;
  for (const double weight : sums.kinds[0])
    inside += weight;
  map.floor = matter.settings.floor * inside / (count * volume);
  if (amounts.kind() == MapQuantity::Kind::column) map.value_floor = map.floor;
  if (amounts.kind() == MapQuantity::Kind::counts) map.value_floor = map.floor * volume;
  map.values = values_of(
      sums, amounts, [volume](std::size_t) { return volume; }, map.floor);
  map.width = voxels[0];
  map.height = voxels[1];
  constexpr const char* names[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const CellsAlongAxis& cells = grid[axis];
    map.axes.push_back({names[axis], "", cells.count, cells.first,
                        cells.first + cells.count * cells.width, false});
  }
  map.images = matter.matter.count;
  map.bad = amounts.bad();
  return map;
}

}  // namespace splotchcl
