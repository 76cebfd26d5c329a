#include "device/frame/column_arguments.h"

namespace splotchcl {

void set_strides(const ParticleBuffers& particles, shared::ProjectLaunch& launch) {
  launch.smoothing_length_stride = particles.smoothing_length_stride;
  launch.weight_stride = particles.weight_stride;
  launch.color_stride = particles.color_stride;
  launch.intensity_stride = particles.intensity_stride;
  launch.sort_stride = particles.sort_stride;
  launch.own_color_stride = particles.own_color_stride;
}

Launch& pass_columns(Launch& launch, const ParticleBuffers& particles) {
  return launch.arg(particles.position)
      .arg(particles.smoothing_length)
      .arg(particles.weight)
      .arg(particles.color)
      .arg(particles.intensity)
      .arg(particles.sort_field)
      .arg(particles.own_color);
}

}  // namespace splotchcl
