#include "device/frame/component_colors.h"

#include <vector>

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

}  // namespace

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

}  // namespace splotchcl
