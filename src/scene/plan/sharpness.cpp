#include "scene/plan/sharpness.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/constants.h"
#include "scene/peak_color.h"
#include "scene/plan/cloud_in_picture.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr std::size_t sample_limit = 16384;

// The mean over a pixel is never steeper than of a cloud of this width with the same light.
constexpr double least_sigma = 0.5;

bool reaches(const PictureCloud& cloud, double sigma, const Rectangle& crop) {
  const double reach = 7 * sigma;  // no cloud is drawn farther
  return cloud.x >= crop.x - reach && cloud.x <= crop.x + crop.width + reach &&
         cloud.y >= crop.y - reach && cloud.y <= crop.y + crop.height + reach;
}

}  // namespace

double find_sharpness(const Frame& frame) {
  const std::uint64_t total = particle_count(frame);
  const std::size_t stride = sample_stride(total, sample_limit);
  const double floor_sigma = frame.kernel.width * frame.kernel.min_radius_pixels;
  double sharpest = 0;
  for (const DrawnComponent& component : frame.components) {
    const PeakColors colors(component);
    for (std::size_t first = 0; first < component.particles.count; first += stride) {
      const std::size_t i = sampled_index(first, stride, component.particles.count);
      const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
      if (!cloud) continue;
      const double sigma = std::hypot(cloud->sigma, floor_sigma);
      if (!reaches(*cloud, sigma, frame.crop)) continue;
      const double light =
          colors(i) / component.reference_column * cloud->column * cloud->sigma / sigma;
      sharpest = std::max(sharpest,
                          light * std::min(1.0, pi * sigma * sigma) / std::max(sigma, least_sigma));
    }
  }
  return sharpest;
}

}  // namespace splotchcl
