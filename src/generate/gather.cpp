#include "generate/gather.h"

#include <algorithm>
#include <cmath>

namespace splotchcl {
namespace {

// Along each axis in turn: a quarter, a half, a quarter. Adds 1/2 to the variance. Neighbors along
// an axis are `stride` apart; whole rows of them are blurred together, in the order of memory.
void blur_once(std::vector<float>& values, std::size_t side) {
  for (std::size_t stride = 1; stride < values.size(); stride *= side) {
    const std::vector<float> old = values;
    for (std::size_t first = 0; first < values.size(); first += stride * side) {
      for (std::size_t i = 0; i < side; ++i) {
        const float* const here = &old[first + i * stride];
        const float* const before = &old[first + (i + side - 1) % side * stride];
        const float* const after = &old[first + (i + 1) % side * stride];
        float* const blurred = &values[first + i * stride];
        for (std::size_t j = 0; j < stride; ++j)
          blurred[j] = 0.5F * here[j] + 0.25F * (before[j] + after[j]);
      }
    }
  }
}

}  // namespace

PeriodicGrid smoothed_density(const std::vector<Vec3>& places, int side, double width) {
  const auto across = static_cast<std::size_t>(side);
  std::vector<float> values(across * across * across);
  for (const Vec3& place : places) {
    const CellCorners corners(place, side);
    for (int corner = 0; corner < 8; ++corner) {
      values[corners.index(corner)] += static_cast<float>(corners.weight(corner));
    }
  }
  for (int pass = 0; pass < std::lround(2 * width * width); ++pass)
    blur_once(values, across);
  return {side, std::move(values)};
}

Vec3 step_uphill(const PeriodicGrid& density, const Vec3& place, double width) {
  const double cell = 1.0 / density.side();
  const double here = density.interpolate(place);
  Vec3 step = {{0, 0, 0}};
  if (!(here > 0)) return step;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 before = place, after = place;
    before.a[axis] -= cell;
    after.a[axis] += cell;
    const double slope = (density.interpolate(after) - density.interpolate(before)) / 2;
    step.a[axis] = std::clamp(width * width * slope / here, -width, width) * cell;
  }
  return step;
}

}  // namespace splotchcl
