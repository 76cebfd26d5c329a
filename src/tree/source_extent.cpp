#include "tree/source_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace splotchcl {
namespace {

SourceExtent empty_extent() {
  SourceExtent extent;
  extent.lower.fill(std::numeric_limits<float>::infinity());
  extent.upper.fill(-std::numeric_limits<float>::infinity());
  return extent;
}

void add(const SourceExtent& other, SourceExtent& all) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.lower[axis] = std::min(all.lower[axis], other.lower[axis]);
    all.upper[axis] = std::max(all.upper[axis], other.upper[axis]);
  }
  all.good += other.good;
}

}  // namespace

SourceExtent find_extent(const TreeSource& source) {
  SourceExtent all = empty_extent();
  std::mutex of_all;
  for_source(source, [&](const TreeStretch& stretch, std::size_t begin, std::size_t end) {
    SourceExtent own = empty_extent();
    for (std::size_t i = begin; i < end; ++i) {
      if (!stretch.is_good(i)) continue;
      ++own.good;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        own.lower[axis] = std::min(own.lower[axis], stretch.position(i, axis));
        own.upper[axis] = std::max(own.upper[axis], stretch.position(i, axis));
      }
    }
    const std::lock_guard lock(of_all);
    add(own, all);
  });
  return all;
}

TreeCube cube_around(const SourceExtent& extent) {
  TreeCube cube;
  double widest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lower = static_cast<double>(extent.lower[axis]);
    const double upper = static_cast<double>(extent.upper[axis]);
    cube.lower.a[axis] = lower;
    widest = std::max({widest, upper - lower, 1e-6 * std::max(std::abs(lower), std::abs(upper))});
  }
  cube.side = widest > 0 ? widest * (1 + 1e-9) : 1;
  return cube;
}

}  // namespace splotchcl
