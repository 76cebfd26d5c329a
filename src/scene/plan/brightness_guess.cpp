#include "scene/plan/brightness_guess.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/constants.h"
#include "scene/peak_color.h"
#include "scene/plan/cloud_in_picture.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr std::size_t brightness_sample_limit = 4096;
constexpr int cells_along = 24;

// The light of sampled clouds, as if it were spread over the cell of their centers, or over
// themselves where they are wider.
class LightOfCells {
 public:
  explicit LightOfCells(const Frame& frame)
      : side_(static_cast<double>(std::max({frame.width, frame.height, 1})) / cells_along),
        columns_(std::max(1, static_cast<int>(std::ceil(frame.width / side_)))),
        rows_(std::max(1, static_cast<int>(std::ceil(frame.height / side_)))),
        light_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(const PictureCloud& cloud, double light_of_column) {
    const int x = cell(cloud.x, columns_), y = cell(cloud.y, rows_);
    if (x < 0 || y < 0) return;
    const double area = pi * cloud.sigma * cloud.sigma;
    light_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x)] +=
        light_of_column * cloud.column * area / std::max(area, side_ * side_);
  }

  double brightest() const { return *std::max_element(light_.begin(), light_.end()); }

 private:
  // Below 0: beside the picture.
  int cell(double place, int count) const {
    const double index = std::floor(place / side_);
    return index >= 0 && index < count ? static_cast<int>(index) : -1;
  }

  double side_;
  int columns_, rows_;
  std::vector<double> light_;
};

}  // namespace

double guess_brightness(const Frame& frame) {
  LightOfCells cells(frame);
  const std::size_t stride = sample_stride(particle_count(frame), brightness_sample_limit);
  for (const DrawnComponent& component : frame.components) {
    const double light =
        static_cast<double>(stride) * peak_emission(component) / component.reference_column;
    for (std::size_t first = 0; first < component.particles.count; first += stride) {
      const std::size_t i = sampled_index(first, stride, component.particles.count);
      if (const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i))
        cells.add(*cloud, light);
    }
  }
  const double brightest = cells.brightest();
  return std::isfinite(brightest) ? brightest : 0;
}

}  // namespace splotchcl
