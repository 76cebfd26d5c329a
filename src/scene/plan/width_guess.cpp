#include "scene/plan/width_guess.h"

#include <cstddef>
#include <optional>

#include "scene/plan/cloud_in_picture.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

// Each is a page of a mapped file that the system has to find.
constexpr std::size_t width_sample_limit = 512;

// Splats end about so many sigma beside their centers.
constexpr double extent = 3;

bool is_in_picture(const PictureCloud& cloud, const Frame& frame) {
  const double reach = extent * cloud.sigma;
  return cloud.x + reach > 0 && cloud.x - reach < frame.width && cloud.y + reach > 0 &&
         cloud.y - reach < frame.height;
}

}  // namespace

WideSplats guess_wide_splats(const Frame& frame, double narrowest) {
  WideSplats found;
  const std::size_t stride = sample_stride(particle_count(frame), width_sample_limit);
  const double per_pixel =
      static_cast<double>(stride) / (static_cast<double>(frame.width) * frame.height);
  for (const DrawnComponent& component : frame.components) {
    for (std::size_t first = 0; first < component.particles.count; first += stride) {
      const std::size_t i = sampled_index(first, stride, component.particles.count);
      const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
      if (!cloud || cloud->sigma < narrowest || !is_in_picture(*cloud, frame)) continue;
      (cloud->sigma < 2 * narrowest ? found.of_one_octave : found.wider) += per_pixel;
    }
  }
  return found;
}

}  // namespace splotchcl
