#include "scene/plan/tried_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scene/constants.h"

namespace splotchcl {
namespace {

// Of a cell, and what is drawn around it, in pixels.
constexpr int side = 16, around = 32;

// Of clouds beside the picture, the cell at its edge.
int nearest_cell(double place, int count) {
  return static_cast<int>(std::clamp(std::floor(place / side), 0.0, count - 1.0));
}

bool is_beside(const SampledCloud& cloud, const Frame& frame) {
  return cloud.x < 0 || cloud.x >= frame.width || cloud.y < 0 || cloud.y >= frame.height;
}

// Of errors of a sum of so much light, what they do to what is promised: nothing absorbed shows as
// a part of itself, and what is deep hides what is added. Palettes' brightest colors say three or
// four times as much as there is.
double shown_part(LightPlan plan, double light) {
  constexpr double overstated = 4;
  if (plan == LightPlan::emission) return 1 / std::max(1.0, light);
  return plan == LightPlan::proportional ? std::exp(-light / overstated) : 1;
}

bool are_near(const Rectangle& a, const Rectangle& b) {
  return std::abs(a.x - b.x) < around && std::abs(a.y - b.y) < around;
}

}  // namespace

LightMap::LightMap(const std::vector<SampledCloud>& clouds, const Frame& frame)
    : width_(frame.width),
      height_(frame.height),
      columns_((frame.width - 1) / side + 1),
      rows_((frame.height - 1) / side + 1),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  constexpr double widest_narrow = 8;            // pixels
  constexpr double brightest = 8;                // brighter ones are drawn by means of their own
  constexpr std::size_t fewest_of_a_sample = 4;  // of fewer a cell tells nothing
  for (const SampledCloud& cloud : clouds) {
    const int x = nearest_cell(cloud.x, columns_), y = nearest_cell(cloud.y, rows_);
    const double area = std::max(1.0, pi * cloud.sigma * cloud.sigma);
    const double of_cell = cloud.weight * std::min(1.0, area / (side * side));
    Cell& cell = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(x)];
    ++cell.clouds;
    if (is_beside(cloud, frame)) {
      cell.beside += of_cell * cloud.light;
      continue;
    }
    cell.light += of_cell * cloud.light;
    if (cloud.sigma < widest_narrow) cell.narrow += of_cell * std::min(cloud.light, brightest);
  }
  const bool is_sample = !clouds.empty() && clouds.front().weight > 1;
  for (Cell& cell : cells_) {
    if (is_sample && cell.clouds < fewest_of_a_sample) cell = {};
  }
}

double LightMap::brightest() const {
  double most = 0;
  for (const Cell& cell : cells_)
    most = std::max(most, cell.light);
  return most;
}

double LightMap::of_bright_quarter() const {
  std::vector<double> lights;
  for (const Cell& cell : cells_)
    lights.push_back(cell.light);
  const auto quarter = lights.end() - 1 - static_cast<std::ptrdiff_t>(lights.size() / 4);
  std::nth_element(lights.begin(), quarter, lights.end());
  return *quarter;
}

bool LightMap::is_at_edge(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_, y = number / columns_;
  return x == 0 || y == 0 || x == columns_ - 1 || y == rows_ - 1;
}

Rectangle LightMap::part_around(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_ * side, y = number / columns_ * side;
  const int left = std::max(x - around, 0), top = std::max(y - around, 0);
  return {left, top, std::min(x + side + around, width_) - left,
          std::min(y + side + around, height_) - top};
}

LightMap::Cell LightMap::most_around(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_, y = number / columns_;
  Cell most;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, rows_ - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, columns_ - 1); ++column) {
      const Cell& other = cells_[static_cast<std::size_t>(row * columns_ + column)];
      most.light = std::max(most.light, other.light);
      most.narrow = std::max(most.narrow, other.narrow);
    }
  }
  return most;
}

std::vector<Rectangle> LightMap::telling_parts(LightPlan light) const {
  std::vector<Rectangle> parts;
  const auto add_largest = [&](const auto& value) {
    const Cell* largest = nullptr;
    double most = 0;
    for (const Cell& cell : cells_) {
      const Cell near = light == LightPlan::ordered ? cell : most_around(cell);
      const double found = value(cell, near) * shown_part(light, cell.light);
      if (found > most) largest = &cell;
      most = std::max(most, found);
    }
    if (largest == nullptr) return;
    const Rectangle part = part_around(*largest);
    if (std::none_of(parts.begin(), parts.end(),
                     [&](const Rectangle& other) { return are_near(part, other); }))
      parts.push_back(part);
  };
  add_largest([](const Cell&, const Cell& near) { return near.light; });
  add_largest(
      [](const Cell& cell, const Cell& near) { return near.narrow / std::max(1.0, cell.light); });
  add_largest([&](const Cell& cell, const Cell& near) {
    return is_at_edge(cell) ? near.light + cell.beside : 0;
  });
  add_largest([&](const Cell& cell, const Cell& near) {
    return is_at_edge(cell) ? near.narrow / std::max(1.0, cell.light) : 0;
  });
  return parts;
}

}  // namespace splotchcl
