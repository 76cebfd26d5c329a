#include "tree/level_arrays.h"

#include <cstddef>
#include <memory>
#include <utility>

namespace splotchcl {
namespace {

// All memory of a tree that is not in a file.
struct Memory {
  LevelsOfTree levels;
  std::array<std::vector<std::uint64_t>, TreeOfType::levels_at_most> first_children, first_loose;
  std::vector<std::uint32_t> order;
};

TreeLevel level_of(Memory& memory, std::size_t l) {
  const LevelArrays& arrays = memory.levels[l];
  std::uint64_t child = 0, loose = memory.order.size();
  for (std::size_t node = 0; node < arrays.nodes.size(); ++node) {
    if (node % TreeLevel::group == 0) {
      memory.first_children[l].push_back(child);
      memory.first_loose[l].push_back(loose);
    }
    for (std::uint8_t mask = arrays.children[node]; mask != 0; mask >>= 1)
      child += mask & 1U;
    loose += arrays.loose[node];
  }
  memory.order.insert(memory.order.end(), arrays.order.begin(), arrays.order.end());
  TreeLevel level;
  level.count = arrays.nodes.size();
  level.nodes = arrays.nodes.data();
  level.fields = arrays.fields.data();
  level.colors = arrays.colors.empty() ? nullptr : arrays.colors.data();
  level.children = arrays.children.data();
  level.loose = arrays.loose.data();
  level.first_children = memory.first_children[l].data();
  level.first_loose = memory.first_loose[l].data();
  return level;
}

}  // namespace

void take_levels(LevelsOfTree levels, TreeOfType& tree) {
  const auto memory = std::make_shared<Memory>();
  memory->levels = std::move(levels);
  for (std::size_t l = 0; l < memory->levels.size() && !memory->levels[l].nodes.empty(); ++l)
    tree.levels.push_back(level_of(*memory, l));
  tree.order = memory->order.data();
  tree.order_count = memory->order.size();
  tree.owner = memory;
}

}  // namespace splotchcl
