#include "tree/drawn_nodes.h"

#include <cmath>
#include <utility>

#include "scene/particle_columns.h"
#include "tree/node_bytes.h"

namespace splotchcl {

void DrawnNodes::add_node(const TreePart& part, const TreeItem& item, std::size_t level,
                          const WeighedNode& weighed) {
  const TreeOfType& tree = part.tree();
  const TreeNode& node = tree.levels[level].nodes[item.node];
  const Vec3 place = place_of(part, item, level, 0).value_or(Vec3{{0, 0, 0}});
  const Vec3& origin = part.drawn->particles.origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    position_.push_back(static_cast<float>(place.a[axis] - origin.a[axis]));
  const double deviation = length_of_bits(node.deviation) * tree.side;
  const double own = length_of_bits(node.size) * part.deviation_per_h * tree.side;
  const double h = std::sqrt(deviation * deviation + own * own) / part.deviation_per_h;
  smoothing_length_.push_back(static_cast<float>(h));
  const double flux = static_cast<double>(node.flux);
  const double weight = part.drawn->weight == WeightModel::mass       ? flux
                        : part.drawn->weight == WeightModel::constant ? flux / h
                                                                      : flux / (h * h * h);
  weight_.push_back(static_cast<float>(weight));
  color_.insert(color_.end(), weighed.color.begin(), weighed.color.end());
}

DrawnComponent DrawnNodes::nodes(const DrawnComponent& component) {
  DrawnComponent merged = component;
  merged.palette = {};
  merged.palette.name = "white";
  merged.palette.emission = {Rgb{1, 1, 1}};
  Particles particles;
  particles.count = smoothing_length_.size();
  particles.origin = component.particles.origin;
  particles.position = Column::owning(std::move(position_));
  particles.smoothing_length = Column::owning(std::move(smoothing_length_));
  particles.weight = Column::owning(std::move(weight_));
  particles.color_vector = Column::owning(std::move(color_));
  merged.particles = std::move(particles);
  return merged;
}

DrawnComponent DrawnNodes::particles(const DrawnComponent& component) const {
  DrawnComponent loose = component;
  loose.particles = picked_particles(component.particles, particles_);
  return loose;
}

}  // namespace splotchcl
