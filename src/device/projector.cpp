#include "device/projector.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "device/exact_parameters.h"
#include "scene/peak_color.h"
#include "scene/projection.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double pi = 3.14159265358979323846;

kernel::FieldScaling scaling_of(const ScalarMap& map) {
  kernel::FieldScaling scaling{};
  scaling.scaling = map.scaling == Scaling::log     ? SCALING_LOG
                    : map.scaling == Scaling::asinh ? SCALING_ASINH
                                                    : SCALING_LINEAR;
  scaling.minimum = static_cast<float>(map.minimum);
  scaling.minimum_low = static_cast<float>(map.minimum - static_cast<double>(scaling.minimum));
  const double range = map.maximum - map.minimum;
  scaling.inverse_range = range > 0 ? static_cast<float>(1 / range) : 0.0f;
  return scaling;
}

// An intensity field that is absent counts as 1.
kernel::FieldScaling intensity_scaling(const DrawnComponent& component) {
  if (!component.particles.intensity.is_absent()) return scaling_of(component.intensity);
  kernel::FieldScaling one{};
  one.scaling = SCALING_LINEAR;
  one.inverse_range = 1;
  return one;
}

// A colour field that is absent is palette position 0, whatever the map says.
kernel::FieldScaling color_scaling(const DrawnComponent& component) {
  if (!component.particles.color.is_absent()) return scaling_of(component.color);
  kernel::FieldScaling zero{};
  zero.scaling = SCALING_LINEAR;
  return zero;
}

void copy(const Vec3& from, float (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis)
    to[axis] = static_cast<float>(from.a[axis]);
}

// A float is at or above the limit exactly when it is at or above this one.
float smallest_float_from(double limit) {
  const auto nearest = static_cast<float>(limit);
  return static_cast<double>(nearest) < limit
             ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
             : nearest;
}

// The same axes with the look-at point for a position.
CameraFrame at_look_at(CameraFrame camera) {
  for (int axis = 0; axis < 3; ++axis) {
    camera.position.a[axis] += camera.look_at_distance * camera.forward.a[axis];
  }
  return camera;
}

Vec3 along_axes(const Vec3& v, const CameraFrame& camera) {
  using boost::qvm::dot;
  return {{dot(v, camera.right), dot(v, camera.down), dot(v, camera.forward)}};
}

std::uint32_t ceil_divide(std::uint32_t value, std::uint32_t by) {
  return value / by + (value % by != 0 ? 1 : 0);
}

}  // namespace

Projector::Projector(DeviceContext& device, const Frame& frame, const FrameLayout& layout,
                     const compute::buffer& grids)
    : device_(device), frame_(frame), layout_(layout), grids_(grids) {}

kernel::ProjectParameters Projector::parameters_for(const DrawnComponent& component,
                                                    std::uint32_t component_index,
                                                    const ParticleBuffers& particles) const {
  kernel::ProjectParameters p{};
  const DepthChain chain = make_depth_chain(frame_.camera, component.particles.origin);
  std::copy(std::begin(chain.position_high), std::end(chain.position_high), p.position_high);
  std::copy(std::begin(chain.position_low), std::end(chain.position_low), p.position_low);
  std::copy(std::begin(chain.forward), std::end(chain.forward), p.forward);
  const DepthChain look_at =
      make_depth_chain(at_look_at(frame_.camera), component.particles.origin);
  std::copy(std::begin(look_at.position_high), std::end(look_at.position_high), p.look_at_high);
  std::copy(std::begin(look_at.position_low), std::end(look_at.position_low), p.look_at_low);
  p.far_away = static_cast<float>(0.5 * frame_.camera.look_at_distance);
  copy(frame_.camera.right, p.right);
  copy(frame_.camera.down, p.down);
  p.perspective = frame_.projection != Projection::orthographic;
  p.pixels_per_length = static_cast<float>(p.perspective ? frame_.camera.focal_pixels
                                                         : frame_.camera.pixels_per_length);
  p.period = static_cast<float>(period_along_x(frame_.camera, frame_.projection));
  p.eye_offset = static_cast<float>(frame_.camera.eye_offset);
  copy(along_axes(frame_.camera.turn_axis, frame_.camera), p.turn_axis);
  p.center_x = static_cast<float>(frame_.camera.center_x - frame_.crop.x);
  p.center_y = static_cast<float>(frame_.camera.center_y - frame_.crop.y);

  // z <= 0 never projects in perspective; the smallest float stands for "above 0".
  const float lowest = p.perspective ? std::numeric_limits<float>::min() : 0.0f;
  p.near_limit = lowest;
  p.near_factor = 0;
  if (frame_.near_limit) {
    p.near_limit = smallest_float_from(*frame_.near_limit);
    if (p.perspective) p.near_limit = std::max(p.near_limit, lowest);
  } else if (p.perspective) {
    p.near_factor = 0.1f;
  }
  p.far_limit = frame_.far_limit ? -smallest_float_from(-*frame_.far_limit)
                                 : std::numeric_limits<float>::infinity();

  p.size_factor = static_cast<float>(component.size_factor);
  p.kernel_width = static_cast<float>(frame_.kernel.width);
  p.kernel_cut = static_cast<float>(frame_.kernel.cut.value_or(0));
  p.min_radius = static_cast<float>(frame_.kernel.min_radius_pixels);
  p.widening = layout_.widening;
  p.mean_sigma = layout_.mean_sigma;
  p.bright_peak = layout_.bright_peak;
  p.crowd_light = layout_.crowd_light;
  p.crowd_bright = layout_.crowd_bright;
  p.crowd_extent = layout_.crowd_extent;
  p.crowd_narrowest = layout_.crowd_narrowest;
  p.crowd_widest = layout_.crowd_widest;

  const double length_scale = splotchcl::length_scale(frame_);
  p.length_scale = static_cast<float>(length_scale);
  switch (component.weight) {
    case WeightModel::mass:
      p.weight_model = WEIGHT_MASS;
      p.weight_scale =
          static_cast<float>(length_scale / std::sqrt(pi * component.reference_column));
      break;
    case WeightModel::density:
      p.weight_model = WEIGHT_DENSITY;
      p.weight_scale =
          static_cast<float>(std::sqrt(pi) / (length_scale * component.reference_column));
      break;
    case WeightModel::constant:
      p.weight_model = WEIGHT_CONSTANT;
      p.weight_scale = static_cast<float>(length_scale / component.reference_column);
      break;
  }
  p.peak_color = static_cast<float>(peak_color(component));
  p.peak_own = static_cast<float>(peak_own_absorption(component));
  p.least_extent = layout_.least_extent;
  // A cut is part of the model: nothing is left out.
  p.restored_light = frame_.kernel.cut ? 0.0f : layout_.restored_light;
  p.inverse_edge = layout_.inverse_edge;
  p.coarse_sigma = layout_.coarse_sigma;
  p.coarse_peak = layout_.coarse_peak;
  p.grid_count = static_cast<int>(layout_.grids.size());
  p.guard = static_cast<float>(layout_.grids.back().guard);
  p.bands = layout_.bands;
  p.blur[0] = static_cast<float>(layout_.blur[0]);
  p.blur[1] = static_cast<float>(layout_.blur[1]);
  p.color = color_scaling(component);
  p.intensity = intensity_scaling(component);
  p.component = component_index;
  p.block_particles = device_.traits.project_block;
  p.smoothing_length_stride = particles.smoothing_length_stride;
  p.weight_stride = particles.weight_stride;
  p.color_stride = particles.color_stride;
  p.intensity_stride = particles.intensity_stride;
  p.sort_stride = particles.sort_stride;
  p.color_vector_stride = particles.color_vector_stride;
  p.sort_by_field = frame_.sort.by == SortOrder::By::field;
  p.sort_descending = frame_.sort.descending;
  return p;
}

compute::program Projector::program(const std::string& outputs) const {
  std::string defines = device_.traits.rows ? "#define LANES_8\n" : "";
  if (layout_.exact_numbers) {
    defines += kernel_defines(frame_, make_plan(frame_), layout_);
    defines += exact_number_defines(device_.traits);
    return device_.programs.get(
        defines + outputs, {"common.cl", "lanes.cl", "exact.cl", "project_exact.cl", "project.cl"});
  }
  if (layout_.vector_colors) defines += "#define VECTOR_COLORS\n";
  if (!is_wide_angle(frame_.projection)) {
    return device_.programs.get(defines + outputs, {"common.cl", "lanes.cl", "project.cl"});
  }
  defines += "#define WIDE_ANGLE\n";
  if (frame_.projection == Projection::fisheye) defines += "#define PROJECTION_FISHEYE\n";
  if (frame_.projection == Projection::equirectangular) {
    defines += "#define PROJECTION_EQUIRECTANGULAR\n#define ELLIPSES\n";
  }
  if (frame_.camera.eye_offset != 0) defines += "#define EYE_OFFSET\n";
  return device_.programs.get(defines + outputs,
                              {"common.cl", "lanes.cl", "wide_angle.cl", "project.cl"});
}

void Projector::make_room(std::uint64_t splats) {
  device_.buffers.get("splats", splats * splat_bytes(layout_));
  if (layout_.exact_numbers)
    device_.buffers.get("exact splats", splats * sizeof(kernel::ExactSplat));
}

void Projector::launch(const compute::program& program, const kernel::ProjectParameters& parameters,
                       const ParticleBuffers& particles, const compute::buffer& offsets,
                       const compute::buffer& visible, std::uint32_t block_count) {
  Buffers& buffers = device_.buffers;
  Launch launch(device_, "project", program.create_kernel("project"));
  launch.value(parameters)
      .arg(grids_)
      .arg(particles.position)
      .arg(particles.smoothing_length)
      .arg(particles.weight)
      .arg(particles.color)
      .arg(particles.intensity)
      .arg(particles.sort_field)
      .arg(offsets)
      .arg(visible)
      .arg(buffers.get("splats", 0))
      .arg(buffers.get("keys", 0))
      .arg(buffers.get("order", 0));
  if (layout_.vector_colors) launch.arg(particles.color_vector);
  if (layout_.exact_numbers) {
    launch.value(make_exact_parameters(frame_, frame_.components[parameters.component]))
        .arg(buffers.get("component colours", 0))
        .arg(buffers.get("palette knots", 0))
        .arg(buffers.get("exact splats", 0));
  }
  launch.run_items(block_count);
}

SplatBlocks Projector::project_chunk(const DrawnComponent& component, std::uint32_t component_index,
                                     const ParticleBuffers& particles, std::uint32_t first,
                                     std::uint32_t end) {
  const compute::program compiled = program("#define OUTPUT_SPLATS\n");
  kernel::ProjectParameters parameters = parameters_for(component, component_index, particles);
  parameters.first_particle = first;
  parameters.end_particle = end;
  SplatBlocks blocks;
  blocks.stride = parameters.block_particles * layout_.splats_per_particle;
  blocks.block_count = ceil_divide(end - first, parameters.block_particles);

  std::vector<std::uint32_t> offsets(blocks.block_count);
  for (std::uint32_t b = 0; b < blocks.block_count; ++b)
    offsets[b] = b * blocks.stride;
  Buffers& buffers = device_.buffers;
  const compute::buffer visible = buffers.get("visible", 8ull * blocks.block_count);
  make_room(std::uint64_t{blocks.block_count} * blocks.stride);
  launch(compiled, parameters, particles, buffers.upload("offsets", offsets), visible,
         blocks.block_count);
  return blocks;
}

void Projector::collect_counts(const SplatBlocks& blocks) {
  std::vector<std::uint32_t> counts(2 * std::size_t{blocks.block_count});
  device_.queue.enqueue_read_buffer(device_.buffers.get("visible", 0), 0,
                                    counts.size() * sizeof(std::uint32_t), counts.data());
  for (std::size_t b = 0; b < blocks.block_count; ++b) {
    visible_particles_ += counts[2 * b];
    bad_particles_ += counts[2 * b + 1];
  }
}

std::uint32_t Projector::project_all(const std::vector<DrawnComponent>& components,
                                     const std::vector<ParticleBuffers>& particles) {
  Buffers& buffers = device_.buffers;
  std::vector<std::uint32_t> first_block = {0};
  for (const DrawnComponent& component : components) {
    first_block.push_back(first_block.back() +
                          ceil_divide(static_cast<std::uint32_t>(component.particles.count),
                                      device_.traits.project_block));
  }
  const std::uint32_t block_count = first_block.back();
  if (block_count == 0) return 0;
  const compute::buffer visible = buffers.get("visible", 8ull * block_count);
  const compute::buffer offsets = buffers.get("offsets", 4ull * (block_count + 1));

  const auto pass = [&](const std::string& defines) {
    const compute::program compiled = program(defines);
    for (std::size_t c = 0; c < components.size(); ++c) {
      const std::uint32_t blocks = first_block[c + 1] - first_block[c];
      if (blocks == 0) continue;
      kernel::ProjectParameters parameters =
          parameters_for(components[c], static_cast<std::uint32_t>(c), particles[c]);
      parameters.first_particle = 0;
      parameters.end_particle = static_cast<std::uint32_t>(components[c].particles.count);
      parameters.first_block = first_block[c];
      launch(compiled, parameters, particles[c], offsets, visible, blocks);
    }
  };
  pass("");
  Launch(device_, "project",
         device_.programs.get("", {"common.cl", "scan.cl"}).create_kernel("scan_blocks"))
      .value(block_count)
      .arg(visible)
      .arg(offsets)
      .run_items(1);
  std::uint32_t splat_count = 0;
  device_.queue.enqueue_read_buffer(offsets, 4ull * block_count, sizeof(splat_count), &splat_count);
  make_room(splat_count);
  buffers.get("keys", 4ull * splat_count);
  buffers.get("order", 4ull * splat_count);
  pass("#define OUTPUT_SPLATS\n#define OUTPUT_KEYS\n");
  collect_counts({block_count, 0});
  return splat_count;
}

}  // namespace splotchcl
