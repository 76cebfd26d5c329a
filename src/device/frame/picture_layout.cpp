#include "device/frame/picture_layout.h"

namespace splotchcl {
namespace {

int ceil_divide(int value, std::uint32_t by) {
  return (value + static_cast<int>(by) - 1) / static_cast<int>(by);
}

}  // namespace

PictureLayout make_picture_layout(const FramePlan& plan, const Specialization& specialization) {
  PictureLayout layout;
  for (const PictureGrid& from : plan.pyramid.grids) {
    shared::Grid grid{};
    grid.width = from.width;
    grid.height = from.height;
    grid.guard = from.guard;
    // Compositing on coarse grids knows center values only: coarse_sigma sees to it.
    grid.mean_sigma = from.level == 0 ? plan.splats.mean_sigma : 0;
    grid.tiles_x = ceil_divide(grid.width, specialization.tile_width());
    grid.tiles_y = ceil_divide(grid.height, specialization.tile_height());
    grid.first_tile = layout.tile_count;
    grid.stride = static_cast<std::uint32_t>(grid.tiles_x) * specialization.tile_width();
    grid.plane_size =
        grid.stride * static_cast<std::uint32_t>(grid.tiles_y) * specialization.tile_height();
    grid.first_float_low = static_cast<std::uint32_t>(layout.plane_floats);
    grid.first_float_high = static_cast<std::uint32_t>(layout.plane_floats >> 32);
    layout.grids.push_back(grid);
    layout.tile_count += static_cast<std::uint32_t>(grid.tiles_x * grid.tiles_y);
    layout.plane_floats += std::uint64_t{specialization.planes()} * grid.plane_size;
  }
  return layout;
}

}  // namespace splotchcl
