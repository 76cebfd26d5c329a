#include "estimate/splat_work.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/plan/cloud_sample.h"

namespace splotchcl {
namespace {

// In sigmas.
double extent_of(const SampledCloud& cloud, const Frame& frame, const FramePlan& plan) {
  if (frame.kernel.cut) return *frame.kernel.cut;
  const double edge = cloud.light * static_cast<double>(plan.splats.inverse_edge);
  return std::max(static_cast<double>(plan.splats.least_extent),
                  std::sqrt(std::log(std::max(edge, 1.0))));
}

std::size_t grid_of(const SampledCloud& cloud, const FramePlan& plan) {
  const std::size_t grids = plan.pyramid.grids.size();
  const double octaves = std::log2(plan.pyramid.over_least_width(cloud.sigma, cloud.light));
  const auto of_level = static_cast<double>(plan.pyramid.grids_of_level());
  const double index = std::floor(of_level * (octaves - plan.pyramid.first_level)) + 1;
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(grids - 1)));
}

// Of the part of [middle - reach, middle + reach] that lies in [first, first + length].
double length_inside(double middle, double reach, int first, int length) {
  const double begin = std::max(middle - reach, static_cast<double>(first));
  const double end = std::min(middle + reach, static_cast<double>(first) + length);
  return std::max(end - begin, 0.0);
}

}  // namespace

SplatWork estimate_splat_work(const Frame& frame, const FramePlan& plan, const Variant& variant) {
  SplatWork work;
  for (const SampledCloud& cloud : sample_clouds(frame)) {
    const std::size_t g = grid_of(cloud, plan);
    const double pixel = std::exp2(plan.pyramid.grids[g].level);
    double sigma = cloud.sigma / pixel;
    const bool is_stencil = g > 0 && plan.pyramid.has_stencils() && cloud.light <= 1;
    if (g > 0 && plan.pyramid.is_blurred() && !is_stencil)
      sigma = std::sqrt(std::max(sigma * sigma - plan.pyramid.blur_of(g), 0.25));
    const double half_stencil = static_cast<double>(stencil_pixels) / 2;
    const double reach =
        (is_stencil ? half_stencil : extent_of(cloud, frame, plan) * sigma) * pixel;
    const Rectangle& crop = frame.crop;
    const double width = length_inside(cloud.x, reach, crop.x, crop.width) / pixel;
    const double height = length_inside(cloud.y, reach, crop.y, crop.height) / pixel;
    const double tiles = (1 + width / variant.tile_width) * (1 + height / variant.tile_height);
    work.splats += cloud.weight;
    work.tile_entries += cloud.weight * tiles;
    work.row_parts += cloud.weight * (1 + height) * (1 + width / 8);
  }
  return work;
}

}  // namespace splotchcl
