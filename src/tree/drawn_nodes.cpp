#include "tree/drawn_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/particle_columns.h"
#include "tree/node_bytes.h"

namespace splotchcl {

DrawnNodes::DrawnNodes(std::size_t nodes, std::size_t particles)
    : position_(3 * nodes),
      smoothing_length_(nodes),
      weight_(nodes),
      color_(3 * nodes),
      particles_(particles) {}

void DrawnNodes::set_node(std::size_t i, const TreePart& part, const TreeItem& item,
                          std::size_t level, const WeighedNode& weighed) {
  const TreeOfType& tree = part.tree();
  const TreeNode& node = tree.levels[level].nodes[item.node];
  const Vec3 place = place_of(part, item, level, 0).value_or(Vec3{{0, 0, 0}});
  const Vec3& origin = part.drawn->particles.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    position_[3 * i + axis] = static_cast<float>(place.a[axis] - origin.a[axis]);
  const double deviation = length_of_bits(node.deviation) * tree.side;
  const double own = length_of_bits(node.size) * part.deviation_per_h * tree.side;
  const double h = std::sqrt(deviation * deviation + own * own) / part.deviation_per_h;
  smoothing_length_[i] = static_cast<float>(h);
  const double flux = static_cast<double>(node.flux);
  const double weight = part.drawn->weight == WeightModel::mass       ? flux
                        : part.drawn->weight == WeightModel::constant ? flux / h
                                                                      : flux / (h * h * h);
  weight_[i] = static_cast<float>(weight);
  std::copy(weighed.color.begin(), weighed.color.end(), &color_[3 * i]);
}

DrawnComponent DrawnNodes::nodes(const DrawnComponent& component) {
  DrawnComponent merged = component;
  merged.palette = {};
  merged.palette.name = "white";
  merged.palette.emission = {Rgb{1, 1, 1}};
  Particles particles;
  particles.count = smoothing_length_.size();
  particles.origin = component.particles.origin;
  particles.position = owning_column(std::move(position_));
  particles.smoothing_length = owning_column(std::move(smoothing_length_));
  particles.weight = owning_column(std::move(weight_));
  particles.color_vector = owning_column(std::move(color_));
  merged.particles = std::move(particles);
  return merged;
}

DrawnComponent DrawnNodes::particles(const DrawnComponent& component) const {
  DrawnComponent loose = component;
  const Particles& in_order = component.particles.tree->in_order;
  loose.particles = picked_particles(in_order.count > 0 ? in_order : component.particles,
                                     particles_, run_on_all_cores);
  return loose;
}

}  // namespace splotchcl
