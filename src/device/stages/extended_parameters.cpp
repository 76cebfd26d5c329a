#include "device/stages/extended_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "device/frame/float_pair.h"
#include "device/stages/field_scaling.h"
#include "scene/particle_rules.h"
#include "scene/plan/splat_limits.h"
#include "scene/projection.h"

namespace splotchcl {
namespace {

void split_in_three(double value, float (&parts)[3]) {
  for (float& part : parts) {
    part = nearest_float(value);
    value -= static_cast<double>(part);
  }
}

void copy(const Vec3& from, shared::FloatPair (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    to[axis] = pair_of(from.a[axis]);
}

void set_camera(const Frame& frame, const DrawnComponent& component,
                shared::ExtendedParameters& e) {
  const CameraFrame& camera = frame.camera;
  for (int axis = 0; axis < 3; ++axis)
    split_in_three(camera.position.a[axis] - component.particles.origin.a[axis], e.position[axis]);
  copy(camera.right, e.right);
  copy(camera.down, e.down);
  copy(camera.forward, e.forward);
  e.pixels_per_length =
      pair_of(frame.projection == Projection::orthographic ? camera.pixels_per_length
                                                           : camera.focal_pixels);
  e.center_x = pair_of(camera.center_x);
  e.center_y = pair_of(camera.center_y);
  const double period = period_along_x(camera, frame.projection);
  e.period = pair_of(period);
  e.twice_pole[0] = pair_of(2 * camera.center_y - 0.5 * period);
  e.twice_pole[1] = pair_of(2 * camera.center_y + 0.5 * period);
  e.eye_offset = pair_of(camera.eye_offset);
  copy(turn_axis_in_view(camera), e.turn_axis);
}

shared::ExtendedFieldScaling pairs_of(const KernelScaling& exact) {
  return {pair_of(exact.minimum), pair_of(exact.factor), pair_of(exact.inverse_range)};
}

}  // namespace

shared::ExtendedParameters make_extended_parameters(const StageContext& context,
                                                    const DrawnComponent& component) {
  const Frame& frame = context.frame;
  shared::ExtendedParameters e{};
  set_camera(frame, component, e);
  e.middle_x = static_cast<float>(context.layout.grids.front().middle_x);
  e.middle_y = static_cast<float>(context.layout.grids.front().middle_y);
  e.center_from_middle_x = pair_of(frame.camera.center_x - static_cast<double>(e.middle_x));
  e.center_from_middle_y = pair_of(frame.camera.center_y - static_cast<double>(e.middle_y));
  e.size_factor = pair_of(component.size_factor);
  e.kernel_width = pair_of(frame.kernel.width);
  e.is_cut = frame.kernel.cut.has_value();
  e.kernel_cut = pair_of(frame.kernel.cut.value_or(0));
  e.reach_of_mean = takes_pixel_means(frame) ? 0.5f : 0;
  e.sums_emission = context.plan.light == LightPlan::emission;
  e.min_radius = pair_of(frame.kernel.min_radius_pixels);
  e.footprint_sigma = pair_of(footprint_sigma(frame.kernel));
  e.lens_sigma = pair_of(sigma_per_scale(frame.lens));
  e.scale_in_focus = pair_of(scale_in_focus(frame));
  e.fade_begin = pair_of(frame.near_limit.value_or(0));
  e.fade_end = pair_of(frame.far_limit.value_or(0));
  e.inverse_near_fade = pair_of(part_per_length(frame.fade.near_length));
  e.inverse_far_fade = pair_of(part_per_length(frame.fade.far_length));
  e.weight_scale = pair_of(weight_scale(component, length_scale(frame)));
  e.color = pairs_of(color_scaling(component));
  e.intensity = pairs_of(intensity_scaling(component));
  e.brightness = pair_of(component.brightness);
  e.absorption_factor = pair_of(component.absorption.factor);
  const auto count = static_cast<double>(std::max<std::uint64_t>(1, particle_count(frame))) *
                     context.plan.splats_per_particle;
  e.inverse_share = static_cast<float>(count / context.plan.shares.truncation);
  return e;
}

}  // namespace splotchcl
