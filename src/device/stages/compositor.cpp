#include "device/stages/compositor.h"

#include <utility>

#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

// Refining and blurring read up to eight pixels past a row's last.
constexpr std::uint64_t padding = 16;

}  // namespace

Compositor::Compositor(const StageContext& context)
    : context_(context), program_(context.device.programs.get(context.specialization.composite())) {
  parameters_.grid_count = static_cast<std::uint32_t>(context.layout.grids.size());
  parameters_.phi_short = context.plan.layers.phi_short;
  parameters_.phi_series = context.plan.layers.phi_series;
  parameters_.stop = context.plan.layers.stop;
}

Planes Compositor::start() const {
  Planes planes;
  planes.light = context_.device.pool.get<float>(context_.layout.plane_floats + padding, "planes");
  clear_grid(0, planes);
  return planes;
}

void Compositor::clear_grid(std::size_t g, Planes& planes) const {
  const shared::Grid& grid = context_.layout.grids[g];
  const std::size_t first =
      grid.first_float_low | (static_cast<std::size_t>(grid.first_float_high) << 32);
  const std::size_t floats = std::size_t{context_.specialization.planes()} * grid.plane_size;
  const cl_float zero = 0;
  DeviceContext& device = context_.device;
  device.timer.add("composite",
                   device.queue.enqueue_fill_buffer(planes.light.memory(), &zero, sizeof(zero),
                                                    4 * first, 4 * floats));
  planes.used_grids |= 1u << g;
}

Planes Compositor::composite(const TileLists& lists, const SplatMemory& splats,
                             Planes planes) const {
  if (lists.segment_count == 0) return planes;
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    const std::uint32_t bit = 1u << g;
    if ((lists.used_grids & bit) && !(planes.used_grids & bit)) clear_grid(g, planes);
  }
  const Specialization& specialization = context_.specialization;
  const std::size_t tile_pixels = specialization.tile_pixels();
  const auto partials = context_.device.pool.get<float>(
      std::uint64_t{specialization.planes()} * tile_pixels * lists.partial_count, "partial layers");
  shared::CompositeParameters parameters = parameters_;
  parameters.segment_count = lists.segment_count;
  Launch launch(context_.device, "composite", program_.create_kernel("composite"));
  launch.value(parameters)
      .arg(context_.grids)
      .arg(lists.segments)
      .arg(lists.entries)
      .arg(planes.light)
      .arg(partials);
  if (specialization.is_extended()) launch.arg(splats.extended);
  if (specialization.has_rows()) {
    launch.run_items(lists.segment_count);
  } else {
    launch.run_groups(lists.segment_count,
                      specialization.is_extended() ? tile_pixels / 8 : tile_pixels);
  }
  if (lists.partial_count > 0) join(lists, parameters, partials, planes);
  return planes;
}

// Layers of tiles that were cut in segments.
void Compositor::join(const TileLists& lists, const shared::CompositeParameters& parameters,
                      const Buffer<float>& partials, const Planes& planes) const {
  DeviceContext& device = context_.device;
  const Specialization& specialization = context_.specialization;
  const bool extended = specialization.is_extended();
  const compute::kernel kernel =
      extended ? program_.create_kernel("join_extended")
               : device.programs.get(specialization.join()).create_kernel("join");
  Launch launch(device, "composite", kernel);
  launch.value(parameters).arg(context_.grids).arg(lists.segments).arg(planes.light).arg(partials);
  if (extended) {
    launch.run_groups(lists.segment_count, specialization.tile_pixels() / 8);
  } else if (!specialization.has_rows()) {
    launch.run_groups(lists.segment_count, specialization.tile_pixels());
  } else {
    launch.run_rows(specialization.tile_height(), lists.segment_count);
  }
}

}  // namespace splotchcl
