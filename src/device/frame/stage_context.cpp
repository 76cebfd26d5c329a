#include "device/frame/stage_context.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "scene/ceil_divide.h"

namespace splotchcl {
namespace {

int kind_number(Absorption::Kind kind) {
  switch (kind) {
    case Absorption::Kind::as_emission:
      return ABSORPTION_AS_EMISSION;
    case Absorption::Kind::none:
      return ABSORPTION_NONE;
    case Absorption::Kind::factor:
      return ABSORPTION_FACTOR;
    case Absorption::Kind::gray:
      return ABSORPTION_GRAY;
  }
  return ABSORPTION_AS_EMISSION;
}

// Returns the number of the first of them in the table.
std::uint32_t append_knots(const std::vector<Rgb>& added, std::vector<float>& table) {
  const auto first = static_cast<std::uint32_t>(table.size() / KNOT_FLOATS);
  for (const Rgb& knot : added)
    table.insert(table.end(), {knot[0], knot[1], knot[2], 0});
  return first;
}

// E w, or A w in the proportional plan, at a cloud's center (scene.h, Absorption). A component that
// only emits has no place in the proportional plan, and a gray one in neither.
void set_summed(LightPlan light, shared::ComponentColors& entry) {
  const bool has_own = light != LightPlan::emission && entry.absorption_knot_count > 0;
  const bool by_factor = light != LightPlan::emission && entry.absorption_kind == ABSORPTION_FACTOR;
  entry.first_summed_knot = has_own ? entry.first_absorption_knot : entry.first_knot;
  const std::uint32_t count = has_own ? entry.absorption_knot_count : entry.knot_count;
  entry.last_summed_knot = static_cast<float>(count) - 1;
  entry.summed_scale = by_factor ? entry.absorption_factor : entry.brightness;
}

ComponentColorTable upload_component_colors(const Frame& frame, LightPlan light, BufferPool& pool) {
  std::vector<shared::ComponentColors> components;
  std::vector<float> knots;
  for (const DrawnComponent& component : frame.components) {
    const Palette& palette = component.palette;
    shared::ComponentColors entry{};
    entry.first_knot = append_knots(palette.emission, knots);
    entry.knot_count = static_cast<std::uint32_t>(palette.emission.size());
    entry.first_absorption_knot = append_knots(palette.absorption, knots);
    entry.absorption_knot_count = static_cast<std::uint32_t>(palette.absorption.size());
    entry.brightness = static_cast<float>(component.brightness);
    entry.absorption_kind = kind_number(component.absorption.kind);
    entry.absorption_factor = static_cast<float>(component.absorption.factor);
    set_summed(light, entry);
    components.push_back(entry);
  }
  // Behind the last knot of a palette the kernels look at one more, of which they take nothing.
  knots.insert(knots.end(), KNOT_FLOATS, 0.0f);
  return {pool.upload(components, "component colors"), pool.upload(knots, "palette knots")};
}

// Below it a thread is done before others have begun.
constexpr std::uint64_t least_shared_bytes = std::uint64_t{1} << 20;

void clear_together(DeviceContext& device, const char* stage, const compute::buffer& memory,
                    std::uint64_t first, std::uint64_t bytes) {
  // As many words as a parameter can count.
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 33;
  const std::uint64_t step = std::min(bytes, most_bytes), word = first / 4;
  const shared::MemoryRange parameters = {static_cast<std::uint32_t>(word),
                                          static_cast<std::uint32_t>(word >> 32),
                                          static_cast<std::uint32_t>(step / 4)};
  const std::size_t items = ceil_divide<std::size_t>(parameters.words, CLEARED_WORDS);
  Launch(device, stage,
         device.programs.get(program_source("kernels/common/clear.cl")).create_kernel("clear"))
      .value(parameters)
      .arg(memory)
      .run_items(items);
  if (step < bytes) clear_together(device, stage, memory, first + step, bytes - step);
}

}  // namespace

StageContext::StageContext(DeviceContext& on, const Frame& of, const FramePlan& with)
    : device(on),
      frame(of),
      plan(with),
      variant(of, with, on.traits),
      layout(make_picture_layout(of, with, variant)),
      grids(on.pool.upload(all_grids(layout), "grids")),
      stencils(on.pool.upload(stencils_of_blurs(with.pyramid), "stencils")),
      colors(upload_component_colors(of, with.light, on.pool)) {}

void clear_memory(DeviceContext& device, const char* stage, const compute::buffer& memory,
                  std::uint64_t first, std::uint64_t bytes) {
  if (device.traits.clears_in_pieces && bytes >= least_shared_bytes) {
    clear_together(device, stage, memory, first, bytes);
    return;
  }
  const cl_uint zero = 0;
  device.timer.add(
      stage,
      device.queue.enqueue_fill_buffer(memory, &zero, sizeof(zero), static_cast<std::size_t>(first),
                                       static_cast<std::size_t>(bytes)),
      StageTimer::Kind::serial);
}

}  // namespace splotchcl
