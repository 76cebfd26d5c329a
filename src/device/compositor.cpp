#include "device/compositor.h"

namespace splotchcl {
Compositor::Compositor(DeviceContext& device, const FrameLayout& layout, const Frame& frame,
                       const Plan& plan, const compute::buffer& grids, bool rows)
    : device_(device), layout_(layout), grids_(grids), rows_(rows) {
  parameters_.grid_count = static_cast<std::uint32_t>(layout.grids.size());
  parameters_.mean_sigma = layout.mean_sigma;
  parameters_.phi_short = layout.phi_short;
  parameters_.phi_series = layout.phi_series;
  parameters_.opaque = layout.opaque;
  const std::string defines = kernel_defines(frame, plan, layout);
  program_ = device.programs.get(
      defines + (rows ? "#define LANES_8\n" : ""),
      {"common.cl", "lanes.cl", "shape.cl", rows ? "composite_rows.cl" : "composite_groups.cl"});
  join_program_ = device.programs.get(defines, {"common.cl", "join.cl"});
  planes_ = device.buffers.get("planes", 4 * layout.plane_floats);
}

void Compositor::clear() {
  const cl_float zero = 0;
  device_.timer.add("composite", device_.queue.enqueue_fill_buffer(
                                     planes_, &zero, sizeof(zero), 0,
                                     4 * static_cast<std::size_t>(layout_.plane_floats)));
}

void Compositor::composite(const TileLists& lists) {
  if (lists.segment_count == 0) return;
  const std::uint64_t tile_floats =
      std::uint64_t{layout_.planes} * layout_.tile_width * layout_.tile_height;
  const compute::buffer partials =
      device_.buffers.get("partial layers", 4 * tile_floats * lists.partial_count);
  Launch launch(device_, "composite", program_.create_kernel("composite"));
  launch.value(parameters_)
      .arg(grids_)
      .arg(lists.segments)
      .arg(lists.totals)
      .arg(lists.entries)
      .arg(planes_)
      .arg(partials);
  if (rows_) {
    launch.run_items(lists.segment_count);
  } else {
    launch.run_groups(lists.segment_count, std::size_t{layout_.tile_width} * layout_.tile_height);
  }
  if (lists.partial_count == 0) return;
  Launch(device_, "composite", join_program_.create_kernel("join"))
      .value(parameters_.grid_count)
      .arg(grids_)
      .arg(lists.segments)
      .arg(lists.totals)
      .arg(planes_)
      .arg(partials)
      .run_rows(layout_.tile_height, lists.segment_count);
}

}  // namespace splotchcl
