#include "device/stages/light_adder.h"

#include <utility>

#include "device/opencl/launch.h"

namespace splotchcl {

void LightAdder::add(const char* kernel, const shared::AddLightParameters& parameters,
                     std::size_t planes, const Buffer<float>& to, const Buffer<float>& from) const {
  Launch(context_.device, "composite",
         context_.device.programs.get(program_source("kernels/composite/add_light.cl"))
             .create_kernel(kernel))
      .value(parameters)
      .arg(to)
      .arg(from)
      .run_grid((parameters.plane_floats + 7) / 8, planes, 1);
}

void LightAdder::add_planes(const Planes& to, const Planes& from, std::size_t g) const {
  const shared::Grid& grid = context_.layout.grids[g];
  const std::size_t planes = context_.variant.planes();
  const shared::AddLightParameters parameters = {grid.first_float_low, grid.first_float_high,
                                                 grid.plane_size};
  const bool is_pairs = context_.variant.extended;
  if ((to.used_grids >> g & 1) != 0) {
    add(is_pairs ? "add_pairs_of_light" : "add_light", parameters, is_pairs ? planes / 2 : planes,
        to.light, from.light);
    return;
  }
  const std::size_t first = floats_before(grid) * sizeof(float);
  context_.device.timer.add(
      "composite",
      context_.device.queue.enqueue_copy_buffer(from.light.memory(), to.light.memory(), first,
                                                first, planes * grid.plane_size * sizeof(float)),
      StageTimer::Kind::serial);
}

SplatLight LightAdder::add(SplatLight to, SplatLight from) const {
  for (std::size_t g = 0; g < context_.layout.grids.size(); ++g) {
    if ((from.planes.used_grids >> g & 1) != 0) add_planes(to.planes, from.planes, g);
  }
  to.planes.used_grids |= from.planes.used_grids;
  if (to.cells.size() == 0) {
    to.cells = std::move(from.cells);
  } else if (from.cells.size() > 0) {
    const shared::AddLightParameters cells = {0, 0, static_cast<std::uint32_t>(to.cells.size())};
    add("add_light", cells, 1, to.cells, from.cells);
  }
  return to;
}

}  // namespace splotchcl
