#include "tree/node_limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

constexpr double standard_deviations = 6;
// A node alone may err by this many of its own standard deviations.
constexpr double most_of_one_node = 10;
// Before limits are corrected: squared errors of nodes, added up over pixels, over their squared
// light. Measured for clumps; corrections take care of the rest.
constexpr double usual_error2 = 4.4e-5;
// A part of what is promised is left for what corrections miss.
constexpr double part_that_is_taken = 0.8;
// What nodes take grows by less than their limit.
constexpr double power_of_limit = 1.2, most_widened = 8, most_narrowed = 30;

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

double NodeLimits::promised(double light) const {
  const double error = error_ * (has_sums_ ? std::max(1.0, 0.5 * light) : 1);
  return std::pow(error / standard_deviations, 2);
}

// Where n nodes of a cell share its light I evenly and their squared errors are e^2 of their
// squared light, they make a variance of 16 e^2 I^2 / n. It is V where each errs by V^2 / (e^2
// I^2).
void NodeLimits::see(const ErrorCells& light) {
  const CellNumbers lights = light.least_totals();
  promised_.resize(lights.size());
  of_node_.resize(lights.size());
  for (std::size_t s = 0; s < lights.size(); ++s) {
    promised_[s].resize(lights[s].size());
    if (!is_corrected_) of_node_[s].resize(lights[s].size());
    for (std::size_t cell = 0; cell < lights[s].size(); ++cell) {
      const double variance = promised_[s][cell] = promised(lights[s][cell]);
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
    if (promised_[0][cell] > 0) largest = std::max(largest, taken[0][cell] / promised_[0][cell]);
  }
  return std::sqrt(largest);
}

}  // namespace splotchcl
