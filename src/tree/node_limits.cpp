#include "tree/node_limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

constexpr double standard_deviations = 6;
// A node alone may err by this many of its own standard deviations. None of 400 random ones did by
// more than 4.5, but with 6 or 8 squares fail whose whole picture is then cut anew.
constexpr double most_of_one_node = 10;
// Before limits are corrected: squared errors of nodes, added up over pixels, over their squared
// light. Measured for clumps; corrections take care of the rest.
constexpr double usual_error2 = 4.4e-5;
// A part of what is promised is left for what corrections miss.
constexpr double part_that_is_taken = 0.8;
// What nodes take grows by less than their limit.
constexpr double power_of_limit = 1.2, most_widened = 8, most_narrowed = 30;

// Of each cell's light the least around it: beside a peak pixels are darker than their cell.
std::vector<double> least_around(const ErrorCells& cells, const std::vector<double>& lights) {
  const int columns = cells.columns(0);
  const int rows = static_cast<int>(lights.size()) / columns;
  const auto least_along = [&](const std::vector<double>& of, int step_x, int step_y) {
    std::vector<double> least = of;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        for (const int side : {-1, 1}) {
          const int beside_x = std::clamp(x + side * step_x, 0, columns - 1);
          const int beside_y = std::clamp(y + side * step_y, 0, rows - 1);
          double& own = least[static_cast<std::size_t>(y * columns + x)];
          own = std::min(own, of[static_cast<std::size_t>(beside_y * columns + beside_x)]);
        }
      }
    }
    return least;
  };
  return least_along(least_along(lights, 1, 0), 0, 1);
}

// Of limits at scale 0 the geometric mean of those within each larger cell.
void widen(const ErrorCells& cells, CellNumbers& limits) {
  for (std::size_t s = 1; s < limits.size(); ++s) {
    std::vector<double> logs(limits[s].size(), 0), counts(limits[s].size(), 0);
    for (std::size_t cell = 0; cell < limits[s - 1].size(); ++cell) {
      const std::size_t parent = cells.parent(static_cast<int>(s) - 1, cell);
      logs[parent] += std::log(std::max(limits[s - 1][cell], 1e-300));
      counts[parent] += 1;
    }
    for (std::size_t cell = 0; cell < logs.size(); ++cell)
      limits[s][cell] = std::exp(logs[cell] / counts[cell]);
  }
}

}  // namespace

double variance_of(const WeighedNode& node, const ErrorCells& cells) {
  const double pixels = cells.pixels(node.scale);
  return static_cast<double>(node.error2) / (pixels * pixels);
}

NodeLimits::NodeLimits(double error, bool has_sums, const BlockErrors& parts, const Rectangle& crop)
    : error_(error), has_sums_(has_sums) {
  ErrorCells cells(crop.width, crop.height);
  const int columns = cells.columns(0);
  for (std::size_t cell = 0; cell < cells.count(0); ++cell) {
    const int x = static_cast<int>(cell) % columns, y = static_cast<int>(cell) / columns;
    const float part = parts.errors.empty()
                           ? 1
                           : parts.at(ErrorCells::cell_pixels * x, ErrorCells::cell_pixels * y);
    cells.at(0, cell) = static_cast<double>(part);
  }
  parts_ = cells.least_totals();
}

double NodeLimits::promised(double light) const {
  const double error = error_ * (has_sums_ ? std::max(1.0, 0.5 * light) : 1);
  return std::pow(error / standard_deviations, 2);
}

// Where n nodes of a cell share its light I evenly and their squared errors are e^2 of their
// squared light, they make a variance of 16 e^2 I^2 / n. It is V where each errs by V^2 / (e^2
// I^2).
void NodeLimits::see(const ErrorCells& light) {
  CellNumbers lights = light.least_totals();
  if (has_sums_) lights[0] = least_around(light, lights[0]);
  promised_.resize(lights.size());
  of_node_.resize(lights.size());
  for (std::size_t s = 0; s < lights.size(); ++s) {
    promised_[s].resize(lights[s].size());
    if (!is_corrected_) of_node_[s].resize(lights[s].size());
    for (std::size_t cell = 0; cell < lights[s].size(); ++cell) {
      const double variance = promised_[s][cell] =
          std::pow(parts_[s][cell], 2) * promised(lights[s][cell]);
      if (is_corrected_) continue;
      const double of_light = usual_error2 * lights[s][cell] * lights[s][cell];
      of_node_[s][cell] = variance * variance / std::max(of_light, 1e-30);
    }
  }
}

bool NodeLimits::keeps(const WeighedNode& node, const ErrorCells& cells) const {
  const double variance = variance_of(node, cells);
  if (!(variance > 0)) return true;
  constexpr double deviations = standard_deviations / most_of_one_node;
  const double most = deviations * deviations * promised_[node.scale][node.cell];
  return static_cast<double>(node.error2) < of_node_[node.scale][node.cell] &&
         static_cast<double>(node.largest2) <= most;
}

void NodeLimits::correct(const ErrorCells& used) {
  const CellNumbers taken = used.totals();
  for (std::size_t cell = 0; cell < of_node_[0].size(); ++cell) {
    const double most = part_that_is_taken * promised_[0][cell];
    const double change = std::pow(most / std::max(taken[0][cell], 1e-300), power_of_limit);
    of_node_[0][cell] *= std::clamp(change, 1 / most_narrowed, most_widened);
  }
  widen(used, of_node_);
  is_corrected_ = true;
}

double NodeLimits::largest_part(const ErrorCells& used) const {
  if (promised_.empty()) return 0;
  const CellNumbers taken = used.totals();
  double largest = 0;
  for (std::size_t cell = 0; cell < taken[0].size(); ++cell) {
    const double promised = promised_[0][cell] / std::pow(parts_[0][cell], 2);
    if (promised > 0) largest = std::max(largest, taken[0][cell] / promised);
  }
  return std::sqrt(largest);
}

}  // namespace splotchcl
