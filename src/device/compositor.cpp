#include "device/compositor.h"

namespace splotchcl {
Compositor::Compositor(DeviceContext& device, const FrameLayout& layout, const Frame& frame,
                       const Plan& plan, const compute::buffer& grids, bool rows)
    : device_(device), layout_(layout), grids_(grids), rows_(rows) {
  parameters_.grid_count = static_cast<std::uint32_t>(layout.grids.size());
  parameters_.phi_short = layout.phi_short;
  parameters_.phi_series = layout.phi_series;
  parameters_.opaque = layout.opaque;
  // Refining and blurring read up to eight pixels past a row's last.
  planes_ = device.buffers.get("planes", 4 * (layout.plane_floats + 16));
  const std::string defines = kernel_defines(frame, plan, layout);
  if (layout.exact_numbers) {
    program_ =
        device.programs.get(defines + exact_number_defines(device.traits) + "#define LANES_8\n",
                            {"common.cl", "lanes.cl", "precise.cl", "exact.cl", "exact_lanes.cl",
                             "composite_exact.cl"});
    return;
  }
  program_ = device.programs.get(defines + (rows ? "#define LANES_8\n" : ""),
                                 {"common.cl", "lanes.cl", "shape.cl", "opacity.cl",
                                  rows ? "composite_rows.cl" : "composite_groups.cl"});
  join_program_ = device.programs.get(defines, {"common.cl", "lanes.cl", "opacity.cl", "join.cl"});
}

void Compositor::clear() {
  used_grids_ = 0;
  clear_grid(0);
}

void Compositor::clear_grid(std::size_t g) {
  const kernel::Grid& grid = layout_.grids[g];
  const std::size_t first =
      grid.first_float_low | (static_cast<std::size_t>(grid.first_float_high) << 32);
  const cl_float zero = 0;
  device_.timer.add("composite",
                    device_.queue.enqueue_fill_buffer(
                        planes_, &zero, sizeof(zero), 4 * first,
                        4 * static_cast<std::size_t>(layout_.planes) * grid.plane_size));
  used_grids_ |= 1u << g;
}

void Compositor::composite(const TileLists& lists) {
  if (lists.segment_count == 0) return;
  for (std::size_t g = 0; g < layout_.grids.size(); ++g) {
    const std::uint32_t bit = 1u << g;
    if ((lists.used_grids & bit) && !(used_grids_ & bit)) clear_grid(g);
  }
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
  const std::size_t tile_pixels = std::size_t{layout_.tile_width} * layout_.tile_height;
  if (layout_.exact_numbers) {
    launch.arg(device_.buffers.get("exact splats", 0))
        .run_groups(lists.segment_count, tile_pixels / 8);
  } else if (rows_) {
    launch.run_items(lists.segment_count);
  } else {
    launch.run_groups(lists.segment_count, tile_pixels);
  }
  if (lists.partial_count == 0) return;
  if (layout_.exact_numbers) {
    Launch(device_, "composite", program_.create_kernel("join_exact"))
        .value(parameters_.grid_count)
        .arg(grids_)
        .arg(lists.segments)
        .arg(lists.totals)
        .arg(planes_)
        .arg(partials)
        .run_groups(lists.segment_count, tile_pixels / 8);
    return;
  }
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
