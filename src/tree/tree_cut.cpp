#include "tree/tree_cut.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include "parallel/for_blocks.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_check.h"
#include "tree/drawn_nodes.h"
#include "tree/error_cells.h"
#include "tree/node_limits.h"
#include "tree/node_weighing.h"
#include "tree/tree_parts.h"

namespace splotchcl {
namespace {

// Of one level of one part, in Morton order.
struct Frontier {
  std::size_t part = 0;
  std::vector<TreeItem> items;
  std::vector<WeighedNode> weighed;
};
using Level = std::vector<Frontier>;

bool has_sums(const Frame& frame) {
  return std::all_of(frame.components.begin(), frame.components.end(),
                     [](const auto& c) { return c.absorption.kind == Absorption::Kind::none; });
}

[[noreturn]] void refuse_damaged() {
  throw DataError(
      "the tree of merged particles: found numbers that do not fit together, expected those that "
      "splotchcl tree wrote; write it again, or draw with --tree never");
}

// What nodes that are kept make together.
struct Sums {
  explicit Sums(const Rectangle& crop)
      : errors(crop.width, crop.height),
        alike(crop.width, crop.height),
        light(crop.width, crop.height) {}

  void add(const WeighedNode& node) {
    errors.at(node.scale, node.cell) += variance_of(node, errors);
    add_light(node, light);
    if (!(node.largest2 > 0)) return;
    const double pixels = alike.pixels(node.scale);
    alike.at(node.scale, node.cell) += static_cast<double>(node.error2) /
                                       std::sqrt(static_cast<double>(node.largest2)) /
                                       (pixels * pixels);
  }
  static void add_light(const WeighedNode& node, ErrorCells& light) {
    const double pixels = light.pixels(node.scale);
    light.at(node.scale, node.cell) += static_cast<double>(node.light) / (pixels * pixels);
  }

  ErrorCells errors;  // variances of a pixel
  ErrorCells alike;   // of a pixel, if all erred alike
  ErrorCells light;
};

class Cutter {
 public:
  Cutter(const Frame& frame, const CutSettings& settings)
      : frame_(frame),
        settings_(settings),
        regions_(settings.regions.empty() ? std::vector<Rectangle>{frame.crop} : settings.regions),
        parts_(tree_parts(frame)),
        sums_(frame.crop),
        weigher_(frame, regions_, sums_.errors, settings.only_counts),
        limits_(settings.error, has_sums(frame)) {}

  TreeCut cut() {
    for (int pass = 0; pass < settings_.corrections; ++pass) {
      look_at_all();
      limits_.correct(sums_.errors);
      sums_ = Sums(frame_.crop);
    }
    draws_ = true;
    nodes_.resize(frame_.components.size());
    look_at_all();
    return finished();
  }

 private:
  // From the roots on, level by level.
  void look_at_all() {
    std::vector<Level> seen;
    Level level;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p].tree().levels.empty()) level.push_back({p, {TreeItem{}}, {}});
    }
    for (std::size_t number = 0; !level.empty(); ++number) {
      for (Frontier& frontier : level)
        weigh(frontier, number);
      see_light(level);
      Level next;
      for (const Frontier& frontier : level) {
        Frontier opened = take(frontier, number);
        if (!opened.items.empty()) next.push_back(std::move(opened));
      }
      if (!draws_) seen.push_back(std::move(level));
      level = std::move(next);
    }
    seen_ = std::move(seen);
  }

  void weigh(Frontier& frontier, std::size_t level) {
    frontier.weighed.resize(frontier.items.size());
    const TreePart& part = parts_[frontier.part];
    const Frontier* const before = seen_before(frontier.part, level);
    std::atomic<std::uint64_t> visited{0};
    for_blocks(frontier.items.size(), 1024, [&](std::size_t first, std::size_t last) {
      std::uint64_t own = 0;
      std::size_t known = before == nullptr ? 0 : place_in(*before, frontier.items[first].node);
      for (std::size_t i = first; i < last; ++i) {
        const TreeItem& item = frontier.items[i];
        while (before != nullptr && known < before->items.size() &&
               before->items[known].node < item.node)
          ++known;
        const bool is_known = before != nullptr && known < before->items.size() &&
                              before->items[known].node == item.node;
        if (!is_known) ++own;
        frontier.weighed[i] = is_known ? before->weighed[known] : weigher_.weigh(part, item, level);
      }
      visited += own;
    });
    visited_ += visited;
    constexpr std::uint64_t flags = 2;  // of children and loose particles
    bytes_ +=
        visited * (sizeof(TreeNode) + flags + part.tree().fields.size() * sizeof(SampledField));
  }

  // What the pass before looked at.
  const Frontier* seen_before(std::size_t part, std::size_t level) const {
    if (level >= seen_.size()) return nullptr;
    const auto found = std::find_if(seen_[level].begin(), seen_[level].end(),
                                    [part](const Frontier& f) { return f.part == part; });
    return found == seen_[level].end() ? nullptr : &*found;
  }
  static std::size_t place_in(const Frontier& frontier, std::uint32_t node) {
    const auto found = std::lower_bound(
        frontier.items.begin(), frontier.items.end(), node,
        [](const TreeItem& item, std::uint32_t number) { return item.node < number; });
    return static_cast<std::size_t>(found - frontier.items.begin());
  }

  void see_light(const Level& level) {
    ErrorCells light = sums_.light;
    for (const Frontier& frontier : level) {
      for (const WeighedNode& node : frontier.weighed) {
        if (node.fate == NodeFate::weighed) Sums::add_light(node, light);
      }
    }
    limits_.see(light);
  }

  Frontier take(const Frontier& frontier, std::size_t level) {
    Frontier next{frontier.part, {}, {}};
    next.items.reserve(4 * frontier.items.size());
    for (std::size_t i = 0; i < frontier.items.size(); ++i) {
      const WeighedNode& node = frontier.weighed[i];
      if (node.fate == NodeFate::unseen) continue;
      if (node.fate == NodeFate::weighed && limits_.keeps(node, sums_.errors)) {
        keep(frontier, i, level);
      } else {
        open(parts_[frontier.part], frontier.items[i], level, next.items);
      }
    }
    return next;
  }

  void keep(const Frontier& frontier, std::size_t i, std::size_t level) {
    sums_.add(frontier.weighed[i]);
    if (!draws_) return;
    ++kept_;
    if (settings_.only_counts) return;
    const TreePart& part = parts_[frontier.part];
    nodes_[part.component].add_node(part, frontier.items[i], level, frontier.weighed[i]);
  }

  void open(const TreePart& part, const TreeItem& item, std::size_t level_number,
            std::vector<TreeItem>& next) {
    const TreeOfType& tree = part.tree();
    const TreeLevel& level = tree.levels[level_number];
    std::uint64_t child = level.first_child(item.node);
    const std::uint8_t mask = level.children[item.node];
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((mask >> octant & 1U) == 0) continue;
      if (level_number + 1 >= tree.levels.size() || child >= tree.levels[level_number + 1].count)
        refuse_damaged();
      TreeItem opened;
      opened.node = static_cast<std::uint32_t>(child++);
      for (std::size_t axis = 0; axis < 3; ++axis)
        opened.cell[axis] = 2 * item.cell[axis] + (octant >> axis & 1U);
      next.push_back(opened);
    }
    if (draws_) open_to_particles(part, level, item.node);
  }

  void open_to_particles(const TreePart& part, const TreeLevel& level, std::uint64_t node) {
    const TreeOfType& tree = part.tree();
    const std::uint64_t count = level.loose[node];
    if (count == 0) return;
    const std::uint64_t first = level.first_loose_particle(node);
    if (count > tree.order_count || first > tree.order_count - count) refuse_damaged();
    loose_ += count;
    if (settings_.only_counts) return;
    for (std::uint64_t loose = first; loose < first + count; ++loose) {
      const std::uint64_t place = tree.order[loose];
      if (place >= tree.count) refuse_damaged();
      nodes_[part.component].add_particle(part.part->first + place);
    }
  }

  TreeCut finished() {
    TreeCut cut;
    cut.frame = frame_;
    cut.frame.components.clear();
    for (std::size_t c = 0; c < frame_.components.size(); ++c) {
      const DrawnComponent& component = frame_.components[c];
      if (!is_served(frame_, component)) {
        cut.frame.components.push_back(component);
        continue;
      }
      cut.frame.components.push_back(nodes_[c].nodes(component));
      cut.frame.components.push_back(nodes_[c].particles(component));
    }
    cut.nodes = kept_;
    cut.particles = loose_;
    cut.visited = visited_;
    cut.bytes = bytes_ + cut.particles * sizeof(std::uint32_t);
    cut.estimate = settings_.error * limits_.largest_part(sums_.errors);
    cut.alike = alike();
    return cut;
  }

  BlockErrors alike() const {
    const auto errors = sums_.alike.totals();
    const auto light = sums_.light.least_totals();
    BlockErrors blocks(frame_.crop.width, frame_.crop.height);
    const auto columns = static_cast<std::size_t>(sums_.alike.columns(0));
    constexpr int cells_of_block = BlockErrors::block_pixels / ErrorCells::cell_pixels;
    for (std::size_t cell = 0; cell < errors[0].size(); ++cell) {
      const int x = static_cast<int>(cell % columns) / cells_of_block;
      const int y = static_cast<int>(cell / columns) / cells_of_block;
      const double over = has_sums(frame_) ? std::max(1.0, light[0][cell]) : 1;
      float& block = blocks.errors[static_cast<std::size_t>(y * blocks.columns + x)];
      block = std::max(block, static_cast<float>(errors[0][cell] / over));
    }
    return blocks;
  }

  const Frame& frame_;
  const CutSettings& settings_;
  std::vector<Rectangle> regions_;
  std::vector<TreePart> parts_;
  Sums sums_;
  NodeWeigher weigher_;
  NodeLimits limits_;
  bool draws_ = false;
  std::vector<Level> seen_;        // by the pass before
  std::vector<DrawnNodes> nodes_;  // of each component
  std::uint64_t kept_ = 0, loose_ = 0, visited_ = 0, bytes_ = 0;
};

}  // namespace

bool is_served(const Frame& frame, const DrawnComponent& component) {
  const bool has_own_absorption = component.palette.has_own_absorption();
  return component.particles.tree != nullptr &&
         component.absorption.kind != Absorption::Kind::gray && !has_own_absorption &&
         component.particles.color_vector.is_absent() && frame.sort.by == SortOrder::By::depth &&
         !frame.kernel.cut && frame.kernel.sampling == Sampling::mean &&
         frame.kernel.footprint_pixels > 0 && frame.projection != Projection::cube &&
         !frame.spread && frame.lens.aperture == 0;
}

bool has_served_component(const Frame& frame) {
  return std::any_of(frame.components.begin(), frame.components.end(),
                     [&](const DrawnComponent& c) { return is_served(frame, c); });
}

TreeCut cut_tree(const Frame& frame, const CutSettings& settings) {
  return Cutter(frame, settings).cut();
}

}  // namespace splotchcl
