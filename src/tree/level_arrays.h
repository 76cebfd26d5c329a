#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/particle_tree.h"

namespace splotchcl {

// What a subtree gives to the level arrays.
struct LevelArrays {
  std::vector<TreeNode> nodes;
  std::vector<SampledField> fields;
  std::vector<MeanColor> colors;  // none, or of each node
  std::vector<std::uint8_t> children, loose;
  std::vector<std::uint32_t> order;  // of the level's loose particles

  // A node that comes before the last ones of the level.
  void insert_before(std::size_t last_ones, const LevelArrays& node) {
    std::size_t later = 0;
    for (std::size_t i = loose.size() - last_ones; i < loose.size(); ++i)
      later += loose[i];
    const std::size_t fields_of_node = node.fields.size();
    const auto insert = [](auto& to, const auto& from, std::size_t behind) {
      to.insert(to.end() - static_cast<std::ptrdiff_t>(behind), from.begin(), from.end());
    };
    insert(nodes, node.nodes, last_ones);
    insert(fields, node.fields, last_ones * fields_of_node);
    insert(colors, node.colors, last_ones * node.colors.size());
    insert(children, node.children, last_ones);
    insert(loose, node.loose, last_ones);
    insert(order, node.order, later);
  }

  void append(const LevelArrays& more) {
    const auto add = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(nodes, more.nodes);
    add(fields, more.fields);
    add(colors, more.colors);
    add(children, more.children);
    add(loose, more.loose);
    add(order, more.order);
  }
};
using LevelsOfTree = std::array<LevelArrays, TreeOfType::levels_at_most>;

// Gives a tree its levels, and the memory that they are in.
void take_levels(LevelsOfTree levels, TreeOfType& tree);

}  // namespace splotchcl
