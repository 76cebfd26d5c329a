#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/memory_advice.h"
#include "splotchcl/frame.h"
#include "tree/node_weighing.h"
#include "tree/tree_parts.h"

namespace splotchcl {

// The nodes of a component that are drawn, and particles where no node stands for them. Several
// threads may set different ones.
class DrawnNodes {
 public:
  DrawnNodes(std::size_t nodes, std::size_t particles);

  void set_node(std::size_t i, const TreePart& part, const TreeItem& item, std::size_t level,
                const WeighedNode& weighed);
  void set_particle(std::size_t i, std::uint64_t place) { particles_[i] = place; }

  DrawnComponent nodes(const DrawnComponent& component);
  DrawnComponent particles(const DrawnComponent& component) const;

 private:
  LargeVector<float> position_, smoothing_length_, weight_, color_;
  Places particles_;  // their places in the component
};

}  // namespace splotchcl
