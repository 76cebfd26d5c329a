#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tree/particle_tree.h"

namespace splotchcl {

// What a subtree gives to the level arrays.
struct LevelArrays {
  std::vector<TreeNode> nodes;
  std::vector<SampledField> fields;
  std::vector<std::uint8_t> children, loose;
  std::vector<std::uint32_t> order;  // of the level's loose particles

  void append(const LevelArrays& more) {
    const auto add = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(nodes, more.nodes);
    add(fields, more.fields);
    add(children, more.children);
    add(loose, more.loose);
    add(order, more.order);
  }
};
using LevelsOfTree = std::array<LevelArrays, TreeOfType::levels_at_most>;

// Gives a tree its levels, and the memory that they are in.
void take_levels(LevelsOfTree levels, TreeOfType& tree);

}  // namespace splotchcl
