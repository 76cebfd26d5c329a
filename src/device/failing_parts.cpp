#include "device/failing_parts.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace splotchcl {
namespace {

// A rectangle's blocks, those at x1 and y1 not among them.
struct Blocks {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int area() const { return (x1 - x0) * (y1 - y0); }
};

class Failing {
 public:
  Failing(const BlockErrors& blocks, double promise) : blocks_(blocks), promise_(promise) {}

  bool at(int x, int y) const {
    const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_.columns) +
                       static_cast<std::size_t>(x);
    return static_cast<double>(blocks_.errors[index]) > promise_;
  }

  // The smallest rectangle that has all that fail within this one.
  std::optional<Blocks> bounds(const Blocks& within) const {
    Blocks found = {within.x1, within.y1, within.x0, within.y0};
    for (int y = within.y0; y < within.y1; ++y) {
      for (int x = within.x0; x < within.x1; ++x) {
        if (!at(x, y)) continue;
        found = {std::min(found.x0, x), std::min(found.y0, y), std::max(found.x1, x + 1),
                 std::max(found.y1, y + 1)};
      }
    }
    if (found.x0 >= found.x1) return std::nullopt;
    return found;
  }

  // The two smallest that a cut along an axis makes of it.
  std::pair<Blocks, Blocks> cut(const Blocks& whole) const {
    std::pair<Blocks, Blocks> best = {whole, {}};
    const auto try_cut = [&](const Blocks& first, const Blocks& second) {
      const std::pair<Blocks, Blocks> parts = {*bounds(first), *bounds(second)};
      if (parts.first.area() + parts.second.area() < best.first.area() + best.second.area())
        best = parts;
    };
    // Both parts have some that fail: the whole is their bounds.
    for (int x = whole.x0 + 1; x < whole.x1; ++x)
      try_cut({whole.x0, whole.y0, x, whole.y1}, {x, whole.y0, whole.x1, whole.y1});
    for (int y = whole.y0 + 1; y < whole.y1; ++y)
      try_cut({whole.x0, whole.y0, whole.x1, y}, {whole.x0, y, whole.x1, whole.y1});
    return best;
  }

 private:
  const BlockErrors& blocks_;
  double promise_;
};

}  // namespace

std::vector<Rectangle> failing_parts(const BlockErrors& blocks, double promise, int width,
                                     int height) {
  constexpr std::size_t most_parts = 4;
  constexpr int side = BlockErrors::block_pixels;
  const Failing failing(blocks, promise);
  const std::optional<Blocks> all = failing.bounds({0, 0, blocks.columns, blocks.rows});
  if (!all) return {};
  std::vector<Blocks> parts = {*all};
  while (parts.size() < most_parts) {
    const auto largest =
        std::max_element(parts.begin(), parts.end(),
                         [](const Blocks& a, const Blocks& b) { return a.area() < b.area(); });
    const auto [first, second] = failing.cut(*largest);
    // Another part has all particles projected again, which takes about a tenth of a frame.
    constexpr double worth_it = 0.1;
    const int saved = largest->area() - first.area() - second.area();
    if (saved < worth_it * blocks.columns * blocks.rows) break;
    *largest = first;
    parts.push_back(second);
  }
  std::vector<Rectangle> rectangles;
  for (const Blocks& part : parts) {
    rectangles.push_back({part.x0 * side, part.y0 * side,
                          std::min(part.x1 * side, width) - part.x0 * side,
                          std::min(part.y1 * side, height) - part.y0 * side});
  }
  return rectangles;
}

}  // namespace splotchcl
