#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

#include "device/frame/chunks.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/rank_share.h"
#include "device/ranks/transfers.h"

namespace splotchcl {

// The light of the leaves of a sum (chunks.h), joined by a fixed binary tree: each node is its left
// branch plus its right one, whichever ranks have them, so that all numbers of ranks give the same
// bits. A node belongs to the rank of its first leaf.
class LeafSums {
 public:
  using DrawLeaf = std::function<SplatLight(std::size_t leaf)>;

  // All of them outlive it.
  LeafSums(const StageContext& context, std::size_t leaves, const FrameRanks& ranks,
           const LightTransfer& transfer);

  std::size_t own_leaves() const { return own_.end - own_.first; }
  // This rank's leaves, one after the other, joined as far as that goes. Of few nodes at a time the
  // light is held: no more than the tree is high.
  void draw(const DrawLeaf& draw_leaf) {
    if (leaves_ > 0) draw_parts({0, leaves_}, draw_leaf);
  }
  // Collective: the sum of all, on rank 0; elsewhere nothing.
  SplatLight join() { return leaves_ > 0 ? join_node({0, leaves_}) : SplatLight(); }

 private:
  struct Node {
    std::size_t first, end;  // leaves
  };
  bool is_own(const Node& node) const { return node.first >= own_.first && node.end <= own_.end; }
  int owner_of(const Node& node) const { return owner_of_leaf(node.first, leaves_, ranks_.size()); }
  void draw_parts(const Node& node, const DrawLeaf& draw_leaf);
  SplatLight draw_node(const Node& node, const DrawLeaf& draw_leaf) const;
  SplatLight join_node(const Node& node);

  const StageContext& context_;
  const std::size_t leaves_;
  const FrameRanks& ranks_;
  const LightTransfer& transfer_;
  ChunkRange own_;
  std::map<std::size_t, SplatLight> drawn_;  // of the largest nodes that are this rank's alone
};

}  // namespace splotchcl
