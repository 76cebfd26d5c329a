#include "device/stages/project_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "device/frame/chunks.h"
#include "device/frame/particle_store.h"
#include "scene/ceil_divide.h"
#include "scene/depth_key.h"
#include "scene/particle_rules.h"
#include "scene/peak_color.h"
#include "scene/plan/splat_limits.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {
namespace {

template <typename Real>
void split_in_two(double value, Real& high, Real& low) {
  // Volatile, as in nearest_float().
  const volatile Real nearest = static_cast<Real>(value);
  high = nearest;
  low = std::isfinite(high) ? static_cast<Real>(value - static_cast<double>(high)) : 0;
}

template <typename Real>
void split_in_two(const Vec3& from, Real (&high)[3], Real (&low)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    split_in_two(from.a[axis], high[axis], low[axis]);
}

// How kernels bring a field to [0, 1] (kernels/project/project.h, FieldScaling), before it is
// rounded to what they hold.
struct KernelScaling {
  int scaling = 0;  // SCALING_...
  double minimum = 0, factor = 0, inverse_range = 0;
};

// Of an absent field, whose values are read as 1.
KernelScaling always(double place) {
  return {SCALING_LINEAR, 0, 0, place};
}

KernelScaling kernel_scaling(const ScalarMap& map) {
  const double range = map.maximum - map.minimum;
  const double inverse_range = range > 0 ? 1 / range : 0;
  const bool is_log = map.scaling == Scaling::log;
  if (const std::optional<double> least = least_before_scaling(map)) {
    if (is_log) return {SCALING_LOG_FROM_LEAST, *least, 1 / *least, inverse_range / std::log(10)};
    return {SCALING_ASINH_FROM_LEAST, *least, std::hypot(1, *least), inverse_range};
  }
  const int scaling = is_log                          ? SCALING_LOG
                      : map.scaling == Scaling::asinh ? SCALING_ASINH
                                                      : SCALING_LINEAR;
  return {scaling, map.minimum, 0, inverse_range};
}

// A color field that is absent is palette position 0, whatever the map says; an intensity 1.
KernelScaling color_scaling(const DrawnComponent& component) {
  return component.particles.color.is_absent() ? always(0) : kernel_scaling(component.color);
}

KernelScaling intensity_scaling(const DrawnComponent& component) {
  return component.particles.intensity.is_absent() ? always(1)
                                                   : kernel_scaling(component.intensity);
}

template <typename Scaling>
void set_scaling(const KernelScaling& exact, Scaling& scaling) {
  using Real = decltype(scaling.factor);
  scaling.scaling = exact.scaling;
  split_in_two(exact.minimum, scaling.minimum, scaling.minimum_low);
  scaling.factor = static_cast<Real>(exact.factor);
  scaling.inverse_range = static_cast<Real>(exact.inverse_range);
}

template <typename Real>
void copy(const Vec3& from, Real (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    to[axis] = static_cast<Real>(from.a[axis]);
}

// A float is at or above the limit exactly when it is at or above this one.
float smallest_float_from(double limit) {
  const auto nearest = static_cast<float>(limit);
  return static_cast<double>(nearest) < limit
             ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
             : nearest;
}

template <typename Real>
void set_camera(const Frame& frame, const Vec3& origin, shared::ProjectParameters<Real>& p) {
  const CameraFrame& camera = frame.camera;
  using namespace boost::qvm;
  const Vec3 look_at = camera.position + camera.forward * camera.look_at_distance;
  split_in_two(camera.position - origin, p.position_high, p.position_low);
  split_in_two(look_at - origin, p.look_at_high, p.look_at_low);
  copy(camera.forward, p.forward);
  p.far_away = static_cast<Real>(0.5 * camera.look_at_distance);
  copy(camera.right, p.right);
  copy(camera.down, p.down);
  p.perspective = frame.projection != Projection::orthographic;
  p.pixels_per_length =
      static_cast<Real>(p.perspective ? camera.focal_pixels : camera.pixels_per_length);
  p.eye_offset = static_cast<Real>(camera.eye_offset);
  copy(turn_axis_in_view(camera), p.turn_axis);
}

template <typename Real>
void set_depth_limits(const Frame& frame, shared::ProjectParameters<Real>& p) {
  // Depth keys decide about depths that are close to these limits (view.cl).
  const Real lowest = p.perspective ? std::numeric_limits<float>::min() : 0;
  p.near_limit = lowest;
  p.near_factor = 0;
  if (frame.near_limit) {
    p.near_limit = smallest_float_from(*frame.near_limit);
    if (p.perspective) p.near_limit = std::max<Real>(p.near_limit, lowest);
  } else if (p.perspective) {
    p.near_factor = static_cast<Real>(near_smoothing_lengths);
  }
  p.far_limit = frame.far_limit ? -smallest_float_from(-*frame.far_limit)
                                : std::numeric_limits<float>::infinity();
}

template <typename Real>
void set_fade(const Frame& frame, shared::ProjectParameters<Real>& p) {
  p.fade_begin = static_cast<Real>(frame.near_limit.value_or(0));
  p.fade_end = static_cast<Real>(frame.far_limit.value_or(0));
  p.inverse_near_fade = static_cast<Real>(part_per_length(frame.fade.near_length));
  p.inverse_far_fade = static_cast<Real>(part_per_length(frame.fade.far_length));
}

shared::DepthKeyParameters parameters_of(const DepthKeyScale& scale) {
  shared::DepthKeyParameters p{};
  for (int axis = 0; axis < 3; ++axis) {
    p.origin_from_camera[axis] = wide(scale.origin_from_camera[axis]);
    p.forward[axis] = wide(scale.forward[axis]);
  }
  p.finest_unit = scale.finest_unit;
  p.unit = scale.unit;
  p.perspective = scale.is_perspective;
  p.near_key = wide(scale.near_key);
  p.far_key = wide(scale.far_key);
  p.near_factor = wide(scale.near_factor);
  p.near_exponent = scale.near_exponent;
  return p;
}

template <typename Real>
void set_depth_key(const Frame& frame, const DrawnComponent& component,
                   shared::ProjectParameters<Real>& p) {
  const DepthKeyScale scale = make_depth_key_scale(frame, component);
  p.depth_key = parameters_of(scale);
  const double least = std::ldexp(static_cast<double>(least_perspective_depth), scale.unit);
  p.least_depth = std::max(static_cast<float>(least), std::numeric_limits<float>::min());
  // The camera is held to 2^-48 of its coordinates, and keys are exact to less than the least
  // depth of a perspective camera.
  double from_origin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    from_origin += std::abs(frame.camera.position.a[axis] - component.particles.origin.a[axis]);
  }
  p.depth_rounding = static_cast<Real>(std::ldexp(from_origin, -46) + 2 * least);
}

template <typename Real>
void set_plan(const FramePlan& plan, shared::ProjectParameters<Real>& p) {
  const SplatLimits& limits = plan.splats;
  p.widening = limits.widening;
  p.mean_sigma = limits.mean_sigma;
  p.bright_peak = limits.bright_peak;
  p.bright_mean_sigma = limits.bright_mean_sigma;
  for (std::size_t octave = 0; octave < plan.needs.widths.size(); ++octave) {
    const WidthNeed& need = plan.needs.widths[octave];
    if (need.light > 0 || need.farther > 0) p.octaves_in_need = static_cast<int>(octave) + 1;
    p.has_bright_octaves |= need.light > 0;
  }
  p.least_extent = limits.least_extent;
  p.restored_light = limits.restored_light;
  p.inverse_edge = limits.inverse_edge;
  p.place_error = plan.places.error;
  p.place_error_per_pixel = plan.places.error_per_pixel;
  p.sharp_width = plan.places.sharp_width;
  p.too_sharp_width = plan.places.too_sharp_width;
  p.most_fading = plan.places.most_fading;
  const GridPyramid& pyramid = plan.pyramid;
  p.inverse_coarse_sigma = 1 / pyramid.coarse_sigma;
  p.coarse_peak = pyramid.coarse_peak;
  p.grid_count = static_cast<int>(pyramid.grids.size());
  p.blurs = grid_blurs(pyramid);
}

template <typename Real>
void set_rectangle(const Rectangle& part, const shared::Grid& grid, Real& left, Real& right_end,
                   Real& top, Real& bottom) {
  left = static_cast<Real>(part.x - grid.middle_x);
  right_end = static_cast<Real>(part.x + part.width - grid.middle_x);
  top = static_cast<Real>(part.y - grid.middle_y);
  bottom = static_cast<Real>(part.y + part.height - grid.middle_y);
}

// Where places count from, and what of the picture is drawn.
template <typename Real>
void set_picture(const StageContext& context, shared::ProjectParameters<Real>& p) {
  const Frame& frame = context.frame;
  const FramePlan& plan = context.plan;
  const shared::Grid& grid = context.layout.grids.front();
  p.width = frame.width;
  p.height = frame.height;
  p.middle_x = grid.middle_x;
  p.middle_y = grid.middle_y;
  p.guard = plan.pyramid.grids.back().guard;
  p.tile_count = context.layout.tile_count;
  p.has_parts = context.layout.has_parts();
  p.center_x = static_cast<Real>(frame.camera.center_x - grid.middle_x);
  p.center_y = static_cast<Real>(frame.camera.center_y - grid.middle_y);

  const Rectangle whole = {0, 0, frame.width, frame.height};
  const auto tile_width = static_cast<int>(context.variant.tile_width);
  const auto tile_height = static_cast<int>(context.variant.tile_height);
  const Rectangle drawn = {grid.first_x, grid.first_y,
                           std::min(grid.tiles_x * tile_width, frame.width - grid.first_x),
                           std::min(grid.tiles_y * tile_height, frame.height - grid.first_y)};
  set_rectangle(drawn, grid, p.left, p.right_end, p.top, p.bottom);
  // Whether any splat is too sharp is the whole picture's.
  set_rectangle(plan.places.too_sharp_width > 0 ? whole : drawn, grid, p.seen_left,
                p.seen_right_end, p.seen_top, p.seen_bottom);

  const bool is_whole = frame.crop.width == frame.width && frame.crop.height == frame.height;
  // Of a crop a grid's tiles may begin a tile beside what is wanted of it.
  const int tile = is_whole ? 0 : std::max(tile_width, tile_height);
  p.beside = static_cast<Real>(plan.pyramid.grids.back().guard + 1 + tile);
  // There a splat has fallen to 2e-9 of its peak. In order slabs of fewer splats are thicker ones,
  // which takes longer than the splats that this leaves out (docs/dev/tuning.md, "Slabs").
  constexpr float faded = 4.5f;
  p.sigmas_shown = plan.needs_sort() ? std::numeric_limits<float>::infinity() : faded;
  // Seven sigma reach beyond the truncation of any amplitude that single precision can hold. No
  // splat of a coarse grid is narrower than coarse_sigma of its pixels, but for its widening.
  p.reach = 7 + 1.1f * p.beside / plan.pyramid.coarse_sigma;

  if (plan.is_face_of_cube && frame.kernel.sampling == Sampling::mean) {
    p.footprint = static_cast<Real>(face_footprint);
    p.narrowest_squared = static_cast<Real>(narrowest_on_face_squared);
  }

  const double period = period_along_x(frame.camera, frame.projection);
  p.period = static_cast<Real>(period);
  const auto in_units = [&](double pixels) {
    return wide(static_cast<std::int64_t>(std::llround(std::ldexp(pixels, grid.place_bits))));
  };
  p.period_units = in_units(period);
  for (int pole = 0; pole < 2; ++pole) {
    const double twice =
        2 * (frame.camera.center_y - grid.middle_y) + (pole == 0 ? -0.5 : 0.5) * period;
    p.twice_pole[pole] = static_cast<Real>(twice);
    p.twice_pole_units[pole] = in_units(twice);
  }
}

int weight_model_number(WeightModel model) {
  switch (model) {
    case WeightModel::mass:
      return WEIGHT_MASS;
    case WeightModel::density:
      return WEIGHT_DENSITY;
    case WeightModel::constant:
      return WEIGHT_CONSTANT;
  }
  return WEIGHT_MASS;
}

// Own colors would have to be known particle by particle.
double counted_part(const DrawnComponent& component, double light_behind) {
  const double peak = peak_color(component);
  if (!component.particles.color_vector.is_absent() || peak == 0) return 1;
  return std::max(peak_emission(component), light_behind * peak_absorption(component)) / peak;
}

template <typename Real>
void set_component(const Frame& frame, const DrawnComponent& component, double light_behind,
                   shared::ProjectParameters<Real>& p) {
  const double length_scale = splotchcl::length_scale(frame);
  const bool is_gray = component.absorption.kind == Absorption::Kind::gray;
  p.size_factor = static_cast<Real>(component.size_factor);
  p.length_scale = static_cast<Real>(length_scale);
  p.weight_model = weight_model_number(component.weight);
  p.weight_scale = static_cast<Real>(weight_scale(component, length_scale));
  p.peak_color = static_cast<Real>(peak_color(component));
  p.peak_own = static_cast<Real>(peak_own_absorption(component));
  p.counted_part =
      static_cast<Real>(is_gray ? light_behind : counted_part(component, light_behind));
  p.around_reach =
      static_cast<Real>(all_splat * frame.kernel.width * component.size_factor * length_scale);
  p.gray_absorption = is_gray ? static_cast<Real>(component.absorption.factor) : 0;
  p.brightness = static_cast<Real>(component.brightness);
  p.absorption_factor = static_cast<Real>(component.absorption.factor);
  set_scaling(color_scaling(component), p.color);
  set_scaling(intensity_scaling(component), p.intensity);
}

template <typename Real>
shared::ProjectParameters<Real> parameters_of_component(const StageContext& context,
                                                        std::uint32_t component) {
  const Frame& frame = context.frame;
  shared::ProjectParameters<Real> p{};
  set_camera(frame, frame.components[component].particles.origin, p);
  set_depth_limits(frame, p);
  set_depth_key(frame, frame.components[component], p);
  p.kernel_width = static_cast<Real>(frame.kernel.width);
  p.sigma_per_h = static_cast<Real>(frame.kernel.width * frame.components[component].size_factor);
  p.kernel_cut = static_cast<Real>(frame.kernel.cut.value_or(0));
  p.min_radius = static_cast<Real>(frame.kernel.min_radius_pixels);
  p.footprint_sigma = static_cast<Real>(footprint_sigma(frame.kernel));
  p.lens_sigma = static_cast<Real>(sigma_per_scale(frame.lens));
  p.scale_in_focus = static_cast<Real>(scale_in_focus(frame));
  set_fade(frame, p);
  set_picture(context, p);
  set_plan(context.plan, p);
  set_component(frame, frame.components[component], context.plan.light_behind, p);
  p.place_bits = context.layout.grids.front().place_bits;
  p.component = component;
  p.sort_by_field = frame.sort.by == SortOrder::By::field;
  p.sort_descending = frame.sort.descending;
  p.launch.window_end = wide(end_of_keys);
  return p;
}

// Of extended precision. Splats are as wide as they are and end where all of them together leave
// out no more than the truncation's share; means of all are taken, if means are.
shared::ProjectParameters<double> extended_parameters(const StageContext& context,
                                                      std::uint32_t component) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  auto p = parameters_of_component<double>(context, component);
  p.widening = p.least_extent = p.restored_light = p.gray_absorption = 0;
  p.mean_sigma = takes_pixel_means(context.frame) ? infinity : 0;
  p.bright_peak = infinity;
  p.counted_part = 1;
  const auto particles =
      static_cast<double>(std::max<std::uint64_t>(1, particle_count(context.frame)));
  p.inverse_edge = particles * context.plan.splats_per_particle / context.plan.shares.truncation;
  // Beyond the truncation of any amplitude that single precision holds.
  p.reach = 10;
  return p;
}

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

}  // namespace

shared::ProjectParameters<float> make_project_parameters(const StageContext& context,
                                                         std::uint32_t component) {
  return parameters_of_component<float>(context, component);
}

shared::ProjectParameters<float> make_project_parameters(const StageContext& context,
                                                         const ParticleChunk& chunk,
                                                         const ParticleBuffers& particles) {
  auto p = make_project_parameters(context, chunk.component);
  p.launch.first_particle = static_cast<std::uint32_t>(chunk.first - particles.first);
  p.launch.end_particle = static_cast<std::uint32_t>(chunk.end - particles.first);
  p.launch.block_particles = context.device.traits.project_block;
  set_strides(particles, p.launch);
  return p;
}

Launch& pass_parameters(Launch& launch, const StageContext& context,
                        const shared::ProjectParameters<float>& parameters) {
  if (!context.variant.extended) return launch.value(parameters);
  auto extended = extended_parameters(context, parameters.component);
  extended.launch = parameters.launch;
  return launch.value(extended);
}

std::uint32_t block_count(const shared::ProjectParameters<float>& parameters) {
  return ceil_divide(parameters.launch.end_particle - parameters.launch.first_particle,
                     parameters.launch.block_particles);
}

ParticleBuffers particles_in_view(const StageContext& context, ParticleStore& particles,
                                  const ParticleChunk& chunk) {
  const DrawnComponent& component = context.frame.components[chunk.component];
  if (!component.particles.boxes) return particles.get(component.particles, chunk);
  const ViewBounds bounds(context.frame, component,
                          make_project_parameters(context, chunk.component));
  return particles.get(component.particles, chunk, &bounds);
}

shared::WideInteger wide(std::uint64_t value) {
  return {static_cast<unsigned>(value & 0xffffffffu), static_cast<unsigned>(value >> 32)};
}

shared::WideInteger wide(std::int64_t value) {
  return wide(static_cast<std::uint64_t>(value));
}

shared::SharpParameters make_sharp_parameters(const StageContext& context,
                                              const DrawnComponent& component) {
  const Frame& frame = context.frame;
  const CameraFrame& camera = frame.camera;
  const shared::Grid& grid = context.layout.grids.front();
  shared::SharpParameters e{};
  for (int axis = 0; axis < 3; ++axis)
    split_in_three(camera.position.a[axis] - component.particles.origin.a[axis], e.position[axis]);
  copy(camera.right, e.right);
  copy(camera.down, e.down);
  copy(camera.forward, e.forward);
  e.pixels_per_length =
      pair_of(frame.projection == Projection::orthographic ? camera.pixels_per_length
                                                           : camera.focal_pixels);
  e.center_from_middle_x = pair_of(camera.center_x - grid.middle_x);
  e.center_from_middle_y = pair_of(camera.center_y - grid.middle_y);
  e.eye_offset = pair_of(camera.eye_offset);
  copy(turn_axis_in_view(camera), e.turn_axis);
  return e;
}

}  // namespace splotchcl
