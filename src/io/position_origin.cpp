#include "io/position_origin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Vec3 choose_position_origin(const std::vector<std::array<double, 3>>& sample) {
  Vec3 origin = {{0, 0, 0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& position : sample) {
      const auto rounded = static_cast<double>(static_cast<float>(position[axis]));
      if (std::isfinite(rounded)) values.push_back(rounded);
    }
    origin.a[axis] = median(std::move(values));
  }
  return origin;
}

}  // namespace splotchcl
