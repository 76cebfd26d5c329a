#include "scene/plan/cloud_sample.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/constants.h"
#include "scene/peak_color.h"
#include "scene/plan/cloud_in_picture.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr std::size_t sample_limit = 32768;

bool reaches_picture(const SampledCloud& cloud, const Frame& frame) {
  const double reach = 7 * cloud.sigma;  // no cloud is drawn farther
  return cloud.x >= -reach && cloud.x <= frame.width + reach && cloud.y >= -reach &&
         cloud.y <= frame.height + reach;
}

void sample_component(const DrawnComponent& component, const Frame& frame, std::size_t stride,
                      std::vector<SampledCloud>& sample) {
  const PeakColors colors(component);
  const double least_sigma = frame.kernel.width * frame.kernel.min_radius_pixels;
  for (std::size_t first = 0; first < component.particles.count; first += stride) {
    const std::size_t i = sampled_index(first, stride, component.particles.count);
    const std::optional<PictureCloud> found = cloud_in_picture(component, frame, i);
    if (!found) continue;
    SampledCloud cloud;
    cloud.x = found->x;
    cloud.y = found->y;
    cloud.sigma = std::hypot(found->sigma, least_sigma);
    if (!reaches_picture(cloud, frame)) continue;
    cloud.light = colors(i) / component.reference_column * found->column * found->sigma /
                  cloud.sigma * std::min(1.0, pi * cloud.sigma * cloud.sigma);
    cloud.weight = static_cast<double>(stride);
    sample.push_back(cloud);
  }
}

}  // namespace

std::vector<SampledCloud> sample_clouds(const Frame& frame) {
  const std::size_t stride = sample_stride(particle_count(frame), sample_limit);
  std::vector<SampledCloud> sample;
  for (const DrawnComponent& component : frame.components)
    sample_component(component, frame, stride, sample);
  return sample;
}

}  // namespace splotchcl
