#include "device/failing_parts.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace splotchcl {
namespace {

// A rectangle's blocks, those at x1 and y1 not among them.
struct Blocks {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int area() const { return std::max(0, x1 - x0) * std::max(0, y1 - y0); }
};

constexpr Blocks no_blocks = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0,
                              0};

Blocks together(const Blocks& a, const Blocks& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// The smallest rectangles that have all that fail within each column of a rectangle, and each row.
struct Bounds {
  std::vector<Blocks> of_columns, of_rows;
};

Bounds bounds_within(const BlockErrors& blocks, double promise, const Blocks& within) {
  Bounds bounds;
  bounds.of_columns.assign(static_cast<std::size_t>(within.x1 - within.x0), no_blocks);
  bounds.of_rows.assign(static_cast<std::size_t>(within.y1 - within.y0), no_blocks);
  for (int y = within.y0; y < within.y1; ++y) {
    for (int x = within.x0; x < within.x1; ++x) {
      const std::size_t place =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks.columns) +
          static_cast<std::size_t>(x);
      if (static_cast<double>(blocks.errors[place]) <= promise) continue;
      const Blocks block = {x, y, x + 1, y + 1};
      Blocks& column = bounds.of_columns[static_cast<std::size_t>(x - within.x0)];
      Blocks& row = bounds.of_rows[static_cast<std::size_t>(y - within.y0)];
      column = together(column, block);
      row = together(row, block);
    }
  }
  return bounds;
}

using Halves = std::pair<Blocks, Blocks>;

// The two smallest rectangles that a cut between two lines makes.
void cut_between(const std::vector<Blocks>& lines, Halves& best) {
  std::vector<Blocks> behind(lines.size() + 1, no_blocks);
  for (std::size_t i = lines.size(); i-- > 0;)
    behind[i] = together(lines[i], behind[i + 1]);
  Blocks before = no_blocks;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    before = together(before, lines[i]);
    if (before.area() + behind[i + 1].area() < best.first.area() + best.second.area())
      best = {before, behind[i + 1]};
  }
}

// A rectangle and what it could be cut into.
struct Part {
  Blocks whole;
  Halves halves;
  int saved() const { return whole.area() - halves.first.area() - halves.second.area(); }
};

// The smallest rectangle that has all that fail within this one.
Part part_of(const BlockErrors& blocks, double promise, const Blocks& within) {
  const Bounds bounds = bounds_within(blocks, promise, within);
  const Blocks whole =
      std::accumulate(bounds.of_rows.begin(), bounds.of_rows.end(), no_blocks, together);
  Part part = {whole, {whole, no_blocks}};
  cut_between(bounds.of_columns, part.halves);
  cut_between(bounds.of_rows, part.halves);
  return part;
}

bool saves_less(const Part& a, const Part& b) {
  return a.saved() < b.saved();
}

}  // namespace

std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height, double pixels_of_part) {
  constexpr std::size_t most_parts = 64;
  constexpr int side = BlockErrors::block_pixels;
  std::vector<Part> parts = {part_of(blocks, promise, {0, 0, blocks.columns, blocks.rows})};
  if (parts.front().whole.area() == 0) return {};
  while (parts.size() < most_parts) {
    const auto most = std::max_element(parts.begin(), parts.end(), saves_less);
    if (static_cast<double>(most->saved()) * side * side <= pixels_of_part) break;
    const Halves halves = most->halves;
    *most = part_of(blocks, promise, halves.first);
    parts.push_back(part_of(blocks, promise, halves.second));
  }
  std::vector<Rectangle> rectangles;
  for (const Part& part : parts) {
    const Blocks& whole = part.whole;
    rectangles.push_back({whole.x0 * side, whole.y0 * side,
                          std::min(whole.x1 * side, width) - whole.x0 * side,
                          std::min(whole.y1 * side, height) - whole.y0 * side});
  }
  return rectangles;
}

}  // namespace splotchcl
