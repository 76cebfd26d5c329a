#include "galaxy/sky.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace splotchcl {
namespace {

constexpr double border_fraction = 0.02;                   // of the shorter side
constexpr double deviations_per_median_distance = 1.4826;  // of a Gaussian

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Light> border_pixels(const Image& picture) {
  const int shorter = std::min(picture.width, picture.height);
  const int width = std::max(1, static_cast<int>(std::lround(border_fraction * shorter)));
  std::vector<Light> pixels;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int distance = std::min({x, y, picture.width - 1 - x, picture.height - 1 - y});
      if (distance < width) pixels.push_back(light_at(picture, x, y));
    }
  }
  return pixels;
}

}  // namespace

Sky measure_sky(const Image& picture) {
  const std::vector<Light> border = border_pixels(picture);
  Sky sky;
  std::vector<double> values(border.size());
  const auto median_of = [&](auto&& value) {
    std::transform(border.begin(), border.end(), values.begin(), value);
    return median(values);
  };
  for (std::size_t i = 0; i < 3; ++i)
    sky.level[i] = median_of([i](const Light& light) { return light[i]; });
  const double middle = median_of([](const Light& light) { return mean(light); });
  sky.noise = deviations_per_median_distance *
              median_of([middle](const Light& light) { return std::abs(mean(light) - middle); });
  return sky;
}

Image without_sky(const Image& picture, const Sky& sky) {
  Image result = picture;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    const double above = static_cast<double>(picture.pixels[i]) - sky.level[i % 4];
    result.pixels[i] = static_cast<float>(std::max(0.0, above));
  }
  return result;
}

}  // namespace splotchcl
