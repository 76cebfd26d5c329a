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
  FieldValues values{};
  double flux = 0;
};

struct TreeSamples {
  std::array<TreeSample, sampled_members> samples{};
  std::size_t count = 0;
  bool are_all = true;             // members, each with its own flux
  FieldValues least{}, largest{};  // of all members: what is not sampled may lie there

  void add(const TreeSample& sample) { samples[count++] = sample; }
};

// A particle, or a node of which the parent is made.
struct TreeMember {
  NodeMoments moments;
  TreeSamples samples;
};

TreeMember merge(const std::vector<TreeMember>& members, bool has_fields);

// What a tree keeps of a node of the level.
TreeNode stored_node(const TreeMember& node, int level);

}  // namespace splotchcl
