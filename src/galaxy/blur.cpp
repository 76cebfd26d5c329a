#include "galaxy/blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splotchcl {
namespace {

// weights[i] is that of what lies i away.
std::vector<double> gaussian_weights(double deviation) {
  constexpr double farthest = 3;  // deviations
  std::vector<double> weights;
  for (int i = 0; i <= std::ceil(farthest * deviation); ++i)
    weights.push_back(std::exp(-i * i / (2 * deviation * deviation)));
  return weights;
}

// One line of `count` values, `stride` apart.
void blur_line(const double* in, double* out, int count, std::size_t stride,
               const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < count; ++i) {
    double sum = 0, weight = 0;
    for (int j = std::max(0, i - reach); j <= std::min(count - 1, i + reach); ++j) {
      const double share = weights[static_cast<std::size_t>(std::abs(i - j))];
      sum += share * in[static_cast<std::size_t>(j) * stride];
      weight += share;
    }
    out[static_cast<std::size_t>(i) * stride] = sum / weight;
  }
}

}  // namespace

std::vector<double> blurred(const std::vector<double>& values, int width, double deviation) {
  if (!(deviation > 0)) return values;
  const std::vector<double> weights = gaussian_weights(deviation);
  const auto across = static_cast<std::size_t>(width);
  const int height = static_cast<int>(values.size() / across);
  std::vector<double> rows(values.size()), result(values.size());
  for (int y = 0; y < height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * across;
    blur_line(&values[first], &rows[first], width, 1, weights);
  }
  for (std::size_t x = 0; x < across; ++x)
    blur_line(&rows[x], &result[x], height, across, weights);
  return result;
}

}  // namespace splotchcl
