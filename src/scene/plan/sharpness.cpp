#include "scene/plan/sharpness.h"

#include <algorithm>

#include "scene/plan/cloud_sample.h"

namespace splotchcl {
namespace {

// The mean over a pixel is never steeper than of a cloud of this width with the same light.
constexpr double least_sigma = 0.5;

}  // namespace

double find_sharpness(const Frame& frame) {
  double sharpest = 0;
  for (const SampledCloud& cloud : sample_clouds(frame))
    sharpest = std::max(sharpest, cloud.light / std::max(cloud.sigma, least_sigma));
  return sharpest;
}

}  // namespace splotchcl
