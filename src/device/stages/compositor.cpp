#include "device/stages/compositor.h"

#include <cmath>
#include <utility>

#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
#include "device/stages/project_parameters.h"
#include "device/stages/stage_programs.h"

namespace splotchcl {
namespace {

// Refining and blurring read up to a strip and a blur past a row's last.
constexpr std::uint64_t plane_padding = STRIP + MOST_BLUR_WEIGHTS;

// To a power of two: the parts of lists are others in each chunk, and what the pool has serves
// again.
std::uint64_t rounded_up(std::uint64_t count) {
  std::uint64_t power = 1;
  while (power < count)
    power *= 2;
  return power;
}

CloudTables no_clouds(BufferPool& pool) {
  return {pool.get<shared::CloudEntry>(0, "unused"), pool.get<shared::CloudSplat>(0, "unused"),
          pool.get<float>(0, "unused"), pool.get<shared::DirectionCone>(0, "unused")};
}

}  // namespace

Compositor::Compositor(const StageContext& context)
    : context_(context),
      no_clouds_(no_clouds(context.device.pool)),
      layers_{{}, &no_clouds_},
      slabs_{{}, &no_clouds_} {
  ProgramCache& programs = context.device.programs;
  const Variant& variant = context.variant;
  layers_.composite = programs.get(composite_program(variant));
  if (context.variant.rows) programs.get(program_source("kernels/common/clear.cl"));
  if (context.plan.slabs > 0)
    slabs_.composite = programs.get(composite_program(variant.of_slabs()));
  parameters_.grid_count = static_cast<std::uint32_t>(context.layout.grids.size());
  parameters_.phi_first = context.plan.layers.phi_first;
  parameters_.phi_short = context.plan.layers.phi_short;
  parameters_.phi_third = context.plan.layers.phi_third;
  parameters_.phi_series = context.plan.layers.phi_series;
  parameters_.stop = context.plan.layers.stop;
  parameters_.most_in_block = context.plan.layers.most_in_block;
  const CameraFrame& camera = context.frame.camera;
  parameters_.face = {pair_of(camera.center_x), pair_of(camera.center_y),
                      pair_of(1 / camera.focal_pixels), 0};
  const double cut = context.frame.kernel.cut.value_or(0);
  parameters_.face.cut2 = static_cast<float>(cut * cut / std::log(2));
}

void Compositor::take_clouds(const CloudTables& clouds) {
  layers_.composite = context_.device.programs.get(composite_with_clouds_program(context_.variant));
  layers_.clouds = &clouds;
}

Planes Compositor::room() const {
  Planes planes;
  planes.light =
      context_.device.pool.get<float>(context_.layout.plane_floats + plane_padding, "planes");
  return planes;
}

Planes Compositor::start() const {
  Planes planes = room();
  clear_grid(0, planes);
  return planes;
}

void Compositor::clear_grid(std::size_t g, Planes& planes) const {
  const shared::Grid& grid = context_.layout.grids[g];
  const std::size_t first = floats_before(grid);
  const std::size_t floats = std::size_t{context_.variant.planes()} * grid.plane_size;
  clear_memory(context_.device, "composite", planes.light.memory(), 4 * first, 4 * floats);
  planes.used_grids |= 1u << g;
}

Planes Compositor::composite(const TileLists& lists, const Buffer<std::byte>& splats,
                             Planes planes) const {
  if (lists.segment_count == 0) return planes;
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    const std::uint32_t bit = 1u << g;
    if ((lists.used_grids & bit) && !(planes.used_grids & bit)) clear_grid(g, planes);
  }
  const Variant& variant = context_.variant;
  const auto partials = context_.device.pool.get<float>(
      std::uint64_t{variant.planes()} * variant.tile_pixels() * rounded_up(lists.partial_count),
      "partial layers");
  // Of an ordered plan the picture's own grid has layers, coarse ones have sums.
  const std::uint32_t end_of_layers =
      context_.plan.slabs > 0 ? lists.picture_segments : lists.segment_count;
  draw({0, end_of_layers}, layers_, lists, splats, partials, planes);
  draw({end_of_layers, lists.segment_count}, slabs_, lists, splats, partials, planes);
  return planes;
}

shared::CompositeParameters Compositor::parameters_of(const Part& part) const {
  shared::CompositeParameters parameters = parameters_;
  parameters.first_segment = part.first;
  parameters.end_segment = part.end;
  return parameters;
}

void Compositor::draw(const Part& part, const Kernels& kernels, const TileLists& lists,
                      const Buffer<std::byte>& splats, const Buffer<float>& partials,
                      const Planes& planes) const {
  if (part.first == part.end) return;
  const Variant& variant = context_.variant;
  const std::size_t count = part.end - part.first;
  Launch launch(context_.device, "composite", kernels.composite.create_kernel("composite"));
  launch.value(parameters_of(part))
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(planes.light)
      .arg(partials)
      .arg(splats)
      .arg(kernels.clouds->entries)
      .arg(kernels.clouds->splats)
      .arg(kernels.clouds->directions)
      .arg(kernels.clouds->cones)
      .arg(context_.stencils);
  if (variant.rows) {
    launch.run_pieces(count);
  } else {
    launch.run_groups(count, variant.items_of_tile());
  }
  if (lists.partial_count > 0) join(part, kernels, lists, partials, planes);
}

// Layers of tiles that were cut in segments.
void Compositor::join(const Part& part, const Kernels& kernels, const TileLists& lists,
                      const Buffer<float>& partials, const Planes& planes) const {
  DeviceContext& device = context_.device;
  const Variant& variant = context_.variant;
  const std::size_t count = part.end - part.first;
  const Program program = device.programs.get(&kernels == &slabs_ ? join_program(variant.of_slabs())
                                                                  : join_program(variant));
  Launch launch(device, "composite", program.create_kernel("join"));
  launch.value(parameters_of(part))
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(planes.light)
      .arg(partials);
  if (variant.rows) {
    launch.run_rows(variant.tile_height, count);
  } else {
    launch.run_groups(count * variant.tile_pixels() / GROUP_ITEMS, GROUP_ITEMS);
  }
}

}  // namespace splotchcl
