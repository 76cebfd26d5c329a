#include "tree/tree_parts.h"

#include <cmath>
#include <utility>

#include "scene/constants.h"
#include "tree/tree_cut.h"

namespace splotchcl {
namespace {

TreePart tree_part(const Frame& frame, std::size_t component, const TreeOfComponent::Part& part) {
  const DrawnComponent& drawn = frame.components[component];
  TreePart made;
  made.component = component;
  made.part = &part;
  made.of_component = drawn.particles.tree.get();
  made.drawn = &drawn;
  const ColorRule rule = {part.color, part.intensity, drawn.color, drawn.intensity, drawn.palette};
  if (!rule.uses_fields() || part.tree->colors != rule.key()) made.colors.emplace(rule);
  const double width = frame.kernel.width * drawn.size_factor;
  made.deviation_per_h = width / std::sqrt(2.0);
  const double factor = drawn.weight == WeightModel::mass ? 1
                        : drawn.weight == WeightModel::constant
                            ? pi * width * frame.kernel.width
                            : std::pow(pi, 1.5) * width * width * width;
  const bool absorbs = drawn.absorption.kind == Absorption::Kind::factor;
  // What gives off no light is seen by what it takes.
  const double amount =
      drawn.brightness == 0 && absorbs ? drawn.absorption.factor : drawn.brightness;
  made.light_per_flux = factor * amount / drawn.reference_column;
  if (absorbs && amount > 0) made.least_amplitude = drawn.absorption.factor / amount;
  return made;
}

}  // namespace

std::vector<TreePart> tree_parts(const Frame& frame) {
  std::vector<TreePart> parts;
  for (std::size_t c = 0; c < frame.components.size(); ++c) {
    if (!is_served(frame, frame.components[c])) continue;
    for (const TreeOfComponent::Part& part : frame.components[c].particles.tree->parts)
      parts.push_back(tree_part(frame, c, part));
  }
  return parts;
}

std::optional<Vec3> place_of(const TreePart& part, const TreeItem& item, std::size_t level,
                             double reach) {
  const TreeOfType& tree = part.tree();
  const TreeNode& node = tree.levels[level].nodes[item.node];
  const double cell = std::ldexp(tree.side, -node.cell_level(level));
  const unsigned of_parent = node.is_rest() ? 1 : 0;
  Vec3 place = {{0, 0, 0}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double part_of_cell = (static_cast<double>(node.place[axis]) + 0.5) * 0x1p-16;
    place.a[axis] = tree.origin.a[axis] + cell * ((item.cell[axis] >> of_parent) + part_of_cell);
    const double period = part.of_component->period.a[axis];
    if (!(period > 0)) continue;
    const double center = part.of_component->center.a[axis];
    double d = place.a[axis] - center;
    d -= period * std::round(d / period);
    if (std::abs(d) + reach > 0.5 * period) return std::nullopt;
    place.a[axis] = center + d;
  }
  return place;
}

}  // namespace splotchcl
