#include "scene/plan/cloud_in_picture.h"

#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/particle_rules.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"

namespace splotchcl {

std::optional<PictureCloud> cloud_in_picture(const DrawnComponent& component, const Frame& frame,
                                             std::size_t i) {
  using namespace boost::qvm;
  const Particles& particles = component.particles;
  const double h = component.size_factor * static_cast<double>(particles.smoothing_length[i]);
  const double sigma = frame.kernel.width * h;
  const Vec3 offset = {{static_cast<double>(particles.position[3 * i]),
                        static_cast<double>(particles.position[3 * i + 1]),
                        static_cast<double>(particles.position[3 * i + 2])}};
  const Vec3 from_camera = particles.origin - frame.camera.position + offset;
  const std::optional<Projected> place =
      project_point(along_axes(from_camera, frame.camera), frame.camera, frame.projection);
  if (!place) return std::nullopt;
  if (!is_within_limits(frame, place->depth, h)) return std::nullopt;

  PictureCloud cloud;
  cloud.x = place->x;
  cloud.y = place->y;
  cloud.depth = place->depth;
  // A cloud that is no circle has the light of a circle of the same area.
  const double height = sigma * place->pixels_per_length;
  cloud.sigma = height * std::sqrt(stretch_of_area(*place, height, frame.camera, frame.projection));
  cloud.of_lens = frame.lens.aperture > 0 ? lens_sigma(frame, place->pixels_per_length) : 0;
  const double weight = particles.weight.is_absent() ? 1 : static_cast<double>(particles.weight[i]);
  cloud.column = central_column(component.weight, weight, h, sigma);
  if (!particles.intensity.is_absent()) {
    cloud.column *= normalized(static_cast<double>(particles.intensity[i]), component.intensity);
  }
  cloud.column *= part_after_fade(frame, cloud.depth);
  const bool is_good = std::isfinite(cloud.x) && std::isfinite(cloud.y) &&
                       std::isfinite(cloud.depth) && cloud.sigma > 0 &&
                       std::isfinite(cloud.sigma) && cloud.column > 0 &&
                       std::isfinite(cloud.column);
  if (!is_good) return std::nullopt;
  return cloud;
}

}  // namespace splotchcl
