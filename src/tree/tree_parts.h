#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "splotchcl/frame.h"
#include "tree/field_colors.h"
#include "tree/particle_tree.h"

namespace splotchcl {

// A part of a component that has one tree, and what is the same for all of its nodes.
struct TreePart {
  std::size_t component = 0;
  const TreeOfComponent::Part* part = nullptr;
  const TreeOfComponent* of_component = nullptr;
  const DrawnComponent* drawn = nullptr;
  std::optional<ParticleColors> colors;  // unset: nodes have the mean of this frame's
  double deviation_per_h = 0;            // in lengths
  // Times pixels per length squared: the sum over pixels of light, or of depth without light.
  double light_per_flux = 0;
  double least_amplitude = 0;  // of absorption, over brightness

  const TreeOfType& tree() const { return *part->tree; }
};

// Of all components that a tree serves. The frame has to stay.
std::vector<TreePart> tree_parts(const Frame& frame);

// A node of a tree that is looked at, and its cell along each axis. Unset at first, as there are
// many.
struct TreeItem {
  std::uint32_t node;
  std::array<std::uint32_t, 3> cell;
};

// Where it is drawn; nothing where members that reach so far are drawn at different images.
std::optional<Vec3> place_of(const TreePart& part, const TreeItem& item, std::size_t level,
                             double reach);

}  // namespace splotchcl
