#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "splotchcl/frame.h"
#include "tree/node_weighing.h"
#include "tree/tree_parts.h"

namespace splotchcl {

// The nodes of a component that are drawn, and particles where no node stands for them.
class DrawnNodes {
 public:
  void add_node(const TreePart& part, const TreeItem& item, std::size_t level,
                const WeighedNode& weighed);
  void add_particle(std::uint64_t place) { particles_.push_back(place); }

  std::uint64_t particle_count() const { return particles_.size(); }
  DrawnComponent nodes(const DrawnComponent& component);
  DrawnComponent particles(const DrawnComponent& component) const;

 private:
  std::vector<float> position_, smoothing_length_, weight_, color_;
  std::vector<std::uint64_t> particles_;  // their places in the component
};

}  // namespace splotchcl
