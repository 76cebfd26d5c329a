#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

#include "device/frame/chunks.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/ranks/light_transfer.h"

namespace splotchcl {

// The light of one part of a sum's splats added to that of another.
class LightAdder {
 public:
  explicit LightAdder(const StageContext& context) : context_(context) {}

  SplatLight add(SplatLight to, SplatLight from) const;

 private:
  void add_planes(const Planes& to, const Planes& from, std::size_t grid) const;
  void add(const shared::MemoryRange& parameters, std::size_t numbers, const Buffer<float>& to,
           const Buffer<float>& from) const;

  const StageContext& context_;
};

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
  void draw(const DrawLeaf& draw_leaf);
  // Collective: the sum of all, on rank 0; elsewhere nothing.
  SplatLight join();

 private:
  struct Node {
    std::size_t first, end;  // leaves
  };
  bool is_own(const Node& node) const { return node.first >= own_.first && node.end <= own_.end; }
  int owner_of(const Node& node) const;
  void draw_parts(const Node& node, const DrawLeaf& draw_leaf);
  SplatLight draw_node(const Node& node, const DrawLeaf& draw_leaf) const;
  SplatLight join_node(const Node& node);

  const LightAdder adder_;
  const std::size_t leaves_;
  const FrameRanks& ranks_;
  const LightTransfer& transfer_;
  ChunkRange own_;
  std::map<std::size_t, SplatLight> drawn_;  // of the largest nodes that are this rank's alone
};

}  // namespace splotchcl
