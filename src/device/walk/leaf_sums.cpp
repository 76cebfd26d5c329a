#include "device/walk/leaf_sums.h"

#include <utility>

#include "device/opencl/launch.h"
#include "device/ranks/rank_share.h"
#include "device/stages/stage_programs.h"

namespace splotchcl {
namespace {

void add(const StageContext& context, const shared::MemoryRange& parameters, std::size_t numbers,
         const Buffer<float>& to, const Buffer<float>& from) {
  Launch(context.device, "composite",
         context.device.programs.get(add_light_program(context.variant)).create_kernel("add_light"))
      .value(parameters)
      .arg(to)
      .arg(from)
      .run_grid((parameters.words + 7) / 8, numbers, 1);
}

void add_planes(const StageContext& context, const Planes& to, const Planes& from, std::size_t g) {
  const shared::Grid& grid = context.layout.grids[g];
  const std::size_t planes = context.variant.planes();
  const shared::MemoryRange parameters = {grid.first_float_low, grid.first_float_high,
                                          grid.plane_size};
  if ((to.used_grids >> g & 1) != 0) {
    add(context, parameters, context.variant.extended ? planes / 2 : planes, to.light, from.light);
    return;
  }
  const std::size_t first = floats_before(grid) * sizeof(float);
  context.device.timer.add(
      "composite",
      context.device.queue.enqueue_copy_buffer(from.light.memory(), to.light.memory(), first, first,
                                               planes * grid.plane_size * sizeof(float)),
      StageTimer::Kind::serial);
}

SplatLight add(const StageContext& context, SplatLight to, SplatLight from) {
  for (std::size_t g = 0; g < context.layout.grids.size(); ++g) {
    if ((from.planes.used_grids >> g & 1) != 0) add_planes(context, to.planes, from.planes, g);
  }
  to.planes.used_grids |= from.planes.used_grids;
  if (to.cells.size() == 0) {
    to.cells = std::move(from.cells);
  } else if (from.cells.size() > 0) {
    const shared::MemoryRange cells = {0, 0, static_cast<std::uint32_t>(to.cells.size())};
    add(context, cells, 1, to.cells, from.cells);
  }
  return to;
}

}  // namespace

LeafSums::LeafSums(const StageContext& context, std::size_t leaves, const FrameRanks& ranks,
                   const LightTransfer& transfer)
    : context_(context),
      leaves_(leaves),
      ranks_(ranks),
      transfer_(transfer),
      own_(leaves_of_rank(leaves, ranks.rank(), ranks.size())) {}

void LeafSums::draw_parts(const Node& node, const DrawLeaf& draw_leaf) {
  if (node.end <= own_.first || node.first >= own_.end) return;
  if (is_own(node)) {
    drawn_[node.first] = draw_node(node, draw_leaf);
    return;
  }
  const std::size_t middle = node.first + left_leaves(node.end - node.first);
  draw_parts({node.first, middle}, draw_leaf);
  draw_parts({middle, node.end}, draw_leaf);
}

SplatLight LeafSums::draw_node(const Node& node, const DrawLeaf& draw_leaf) const {
  if (node.end - node.first == 1) return draw_leaf(node.first);
  const std::size_t middle = node.first + left_leaves(node.end - node.first);
  SplatLight left = draw_node({node.first, middle}, draw_leaf);
  SplatLight right = draw_node({middle, node.end}, draw_leaf);
  return add(context_, std::move(left), std::move(right));
}

// A right branch is sent when it is whole, to the rank that has its left one and waits for it.
SplatLight LeafSums::join_node(const Node& node) {
  if (is_own(node)) return std::move(drawn_.at(node.first));
  if (node.end - node.first == 1) return {};  // another rank's
  const std::size_t middle = node.first + left_leaves(node.end - node.first);
  const Node left_node = {node.first, middle}, right_node = {middle, node.end};
  SplatLight left = join_node(left_node), right = join_node(right_node);
  const int own = ranks_.rank(), of_left = owner_of(left_node), of_right = owner_of(right_node);
  if (of_left == own) {
    if (of_right != own) right = transfer_.receive(of_right);
    return add(context_, std::move(left), std::move(right));
  }
  if (of_right == own) transfer_.send(right, of_left);
  return {};
}

}  // namespace splotchcl
