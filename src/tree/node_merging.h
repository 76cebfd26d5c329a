#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tree/node_moments.h"
#include "tree/particle_tree.h"
#include "tree/tree_stretch.h"

namespace splotchcl {

// A member that stands for others, with their flux.
struct TreeSample {
  MemberValues values{};
  double flux = 0;
};

struct TreeSamples {
  std::array<TreeSample, sampled_members> samples{};
  std::size_t count = 0;
  bool are_all = true;              // members, each with its own flux
  MemberValues least{}, largest{};  // of all members: what is not sampled may lie there

  void add(const TreeSample& sample) { samples[count++] = sample; }
};

// Means over members, weighted by their flux.
struct ColorMoments {
  std::array<double, 3> mean{}, square{};         // of each channel
  std::array<std::array<double, 3>, 3> dipole{};  // of its product with the way from the centroid

  static ColorMoments of_particle(const std::array<float, 3>& color);
};

// A particle, or a node of which the parent is made.
struct TreeMember {
  NodeMoments moments;
  TreeSamples samples;
  ColorMoments colors;
};

// What there is besides moments.
struct MergedParts {
  bool samples = false, colors = false;
};
TreeMember merge(const std::vector<TreeMember>& members, const MergedParts& parts);

// What a tree keeps of a node of the level.
TreeNode stored_node(const TreeMember& node, int level);
MeanColor stored_color(const ColorMoments& colors, int level);

}  // namespace splotchcl
