#include "tree/tree_cut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/memory_advice.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_check.h"
#include "tree/drawn_nodes.h"
#include "tree/error_cells.h"
#include "tree/node_limits.h"
#include "tree/node_weighing.h"
#include "tree/tree_parts.h"

namespace splotchcl {
namespace {

// Nodes of one level of one part that were looked at so far. They stay from pass to pass, those of
// a later pass behind those of the ones before.
struct KnownLevel {
  LargeVector<TreeItem> items;
  LargeVector<WeighedNode> weighed;
  LargeVector<std::uint32_t> first_children;  // in the next level
};
constexpr std::uint32_t unknown = 0xffffffff;  // not looked at

// Of one part. A pass goes from level to level.
struct Walk {
  std::size_t part = 0;
  std::vector<KnownLevel> levels;
  LargeVector<std::uint32_t> reached;   // by the pass: of one level, in Morton order
  LargeVector<std::uint8_t> is_opened;  // of these
};

// What is drawn of one level of one part: nodes, and those whose loose particles are, in Morton
// order, as they lie among the known ones.
struct DrawnLevel {
  std::size_t part = 0, level = 0;
  LargeVector<std::uint32_t> kept, opened;
  LargeVector<std::uint64_t> behind;                 // the place behind each opened one's particles
  std::uint64_t first_node = 0, first_particle = 0;  // among the component's
};

bool has_sums(const Frame& frame) {
  return std::all_of(frame.components.begin(), frame.components.end(),
                     [](const auto& c) { return c.absorption.kind == Absorption::Kind::none; });
}

[[noreturn]] void refuse_damaged() {
  throw DataError(
      "the tree of merged particles: found numbers that do not fit together, expected those that "
      "splotchcl tree wrote; write it again, or draw with --tree never");
}

// Of the tree, that are read for a loose particle: its place, or its values.
std::uint64_t bytes_of_particle(const DrawnComponent& component) {
  const Particles& in_order = component.particles.tree->in_order;
  if (in_order.count == 0) return sizeof(std::uint32_t);
  std::uint64_t values = 0;
  for (const Column* const column : in_order.columns())
    values += column->size() / in_order.count;
  return values * sizeof(float);
}

// What nodes that are kept make together.
struct Sums {
  explicit Sums(const Rectangle& crop)
      : errors(crop.width, crop.height),
        alike(crop.width, crop.height),
        light(crop.width, crop.height) {}

  void add(const WeighedNode& node, bool is_drawn) {
    errors.at(node.scale, node.cell) += variance_of(node, errors);
    add_light(node, light);
    if (!is_drawn || !(node.largest2 > 0) || node.is_beside) return;
    const double pixels = alike.pixels(node.scale);
    alike.at(node.scale, node.cell) += static_cast<double>(node.error2) /
                                       std::sqrt(static_cast<double>(node.largest2)) /
                                       (pixels * pixels);
  }
  void add(const Sums& others) {
    errors.add(others.errors);
    alike.add(others.alike);
    light.add(others.light);
  }
  static void add_light(const WeighedNode& node, ErrorCells& light) {
    const double pixels = light.pixels(node.scale);
    light.at(node.scale, node.cell) += static_cast<double>(node.light) / (pixels * pixels);
  }

  ErrorCells errors;  // variances of a pixel
  ErrorCells alike;   // of a pixel, of drawn ones if all erred alike
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
        weigher_(frame, regions_, sums_.errors, settings.only_counts, settings.corrections > 0),
        limits_(settings.error, has_sums(frame), settings.parts_of_error, frame.crop),
        nodes_(frame.components.size(), 0),
        particles_(frame.components.size(), 0) {}

  TreeCut cut() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].tree().levels.empty()) continue;
      walks_.emplace_back();
      walks_.back().part = p;
      look_at_root(walks_.back());
    }
    for (int pass = 0; pass < settings_.corrections; ++pass) {
      walk();
      limits_.correct(sums_.errors);
    }
    draws_ = true;
    walk();
    return finished();
  }

 private:
  void look_at_root(Walk& walk) {
    KnownLevel root;
    root.items.push_back(TreeItem{});
    root.weighed.push_back(weigher_.weigh(parts_[walk.part], root.items[0], 0));
    root.first_children.push_back(unknown);
    ++visited_;
    walk.levels.push_back(std::move(root));
  }

  // From the roots on, level by level.
  void walk() {
    sums_ = Sums(frame_.crop);
    for (Walk& walk : walks_)
      walk.reached.assign(1, 0);
    for (std::size_t level = 0;; ++level) {
      if (std::all_of(walks_.begin(), walks_.end(),
                      [](const Walk& walk) { return walk.reached.empty(); }))
        return;
      see_light(level);
      for (Walk& walk : walks_) {
        if (walk.reached.empty()) continue;
        decide(walk, level);
        if (draws_) note_drawn(walk, level);
        reach_children(walk, level);
      }
    }
  }

  void see_light(std::size_t level) {
    ErrorCells light = sums_.light;
    for (const Walk& walk : walks_) {
      for (const std::uint32_t i : walk.reached) {
        const WeighedNode& node = walk.levels[level].weighed[i];
        if (node.fate == NodeFate::weighed) Sums::add_light(node, light);
      }
    }
    limits_.see(light);
  }

  // Sums are those of a fixed number of stretches, so that they are the same on any number of
  // threads.
  void decide(Walk& walk, std::size_t level) {
    constexpr std::size_t stretches = 8, fewest = 4096;
    const std::size_t count = walk.reached.size();
    const std::size_t stretch = std::max(fewest, ceil_divide(count, stretches));
    const std::size_t parts = ceil_divide(count, stretch);
    std::vector<Sums> sums(parts > 1 ? parts : 0, Sums(frame_.crop));  // one needs no other
    walk.is_opened.resize(count);
    for_blocks(count, stretch, [&](std::size_t first, std::size_t last) {
      Sums& own = sums.empty() ? sums_ : sums[first / stretch];
      for (std::size_t r = first; r < last; ++r) {
        const WeighedNode& node = walk.levels[level].weighed[walk.reached[r]];
        const bool is_kept = node.fate == NodeFate::weighed && limits_.keeps(node, sums_.errors);
        if (is_kept) {
          own.add(node, draws_);
        } else if (node.fate == NodeFate::weighed && node.children == 0) {
          Sums::add_light(node, own.light);  // of its particles
        }
        walk.is_opened[r] = !is_kept && node.fate != NodeFate::unseen;
      }
    });
    for (const Sums& own : sums)
      sums_.add(own);
  }

  // Nodes that were reached are counted stretch by stretch, so that each stretch knows where its
  // own are written.
  static constexpr std::size_t stretch = 16384;

  // How many there are before each stretch, and in all.
  template <class Numbers, class Count>
  static std::vector<Numbers> before_stretches(std::size_t reached, const Count& count) {
    std::vector<Numbers> before(ceil_divide(reached, stretch) + 1);
    for_blocks(reached, stretch, [&](std::size_t first, std::size_t last) {
      Numbers& own = before[first / stretch + 1];
      for (std::size_t r = first; r < last; ++r)
        count(r, own);
    });
    for (std::size_t s = 1; s < before.size(); ++s)
      before[s].add(before[s - 1]);
    return before;
  }

  struct DrawnNumbers {
    std::size_t kept = 0, opened = 0;
    std::uint64_t loose = 0;
    void add(const DrawnNumbers& others) {
      kept += others.kept;
      opened += others.opened;
      loose += others.loose;
    }
  };

  void note_drawn(const Walk& walk, std::size_t level_number) {
    const KnownLevel& level = walk.levels[level_number];
    const std::uint8_t* const loose_of = parts_[walk.part].tree().levels[level_number].loose;
    const auto count = [&](std::size_t r, DrawnNumbers& numbers) {
      const std::uint32_t i = walk.reached[r];
      if (walk.is_opened[r] == 0) {
        numbers.kept += level.weighed[i].fate != NodeFate::unseen ? 1 : 0;
      } else if (const unsigned loose = loose_of[level.items[i].node]) {
        ++numbers.opened;
        numbers.loose += loose;
      }
    };
    const auto before = before_stretches<DrawnNumbers>(walk.reached.size(), count);
    const std::size_t component = parts_[walk.part].component;
    DrawnLevel drawn;
    drawn.part = walk.part;
    drawn.level = level_number;
    drawn.first_node = nodes_[component];
    drawn.first_particle = particles_[component];
    nodes_[component] += before.back().kept;
    particles_[component] += before.back().loose;
    if (settings_.only_counts) return;
    drawn.kept.resize(before.back().kept);
    drawn.opened.resize(before.back().opened);
    drawn.behind.resize(before.back().opened);
    for_blocks(walk.reached.size(), stretch, [&](std::size_t first, std::size_t last) {
      DrawnNumbers at = before[first / stretch];
      for (std::size_t r = first; r < last; ++r) {
        const DrawnNumbers was = at;
        count(r, at);
        if (at.kept > was.kept) drawn.kept[was.kept] = walk.reached[r];
        if (at.opened == was.opened) continue;
        drawn.opened[was.opened] = walk.reached[r];
        drawn.behind[was.opened] = drawn.first_particle + at.loose;
      }
    });
    drawn_.push_back(std::move(drawn));
  }

  struct ChildNumbers {
    std::size_t all = 0, unknown = 0;
    void add(const ChildNumbers& others) {
      all += others.all;
      unknown += others.unknown;
    }
  };

  // The children of opened nodes are reached next, and looked at where they were not yet.
  void reach_children(Walk& walk, std::size_t level_number) {
    const TreeOfType& tree = parts_[walk.part].tree();
    if (walk.levels.size() == level_number + 1) walk.levels.emplace_back();
    KnownLevel& level = walk.levels[level_number];
    KnownLevel& next = walk.levels[level_number + 1];
    const auto count = [&](std::size_t r, ChildNumbers& numbers) {
      if (walk.is_opened[r] == 0) return;
      const std::uint32_t i = walk.reached[r];
      numbers.all += level.weighed[i].children;
      if (level.first_children[i] == unknown) numbers.unknown += level.weighed[i].children;
    };
    const auto before = before_stretches<ChildNumbers>(walk.reached.size(), count);
    const std::size_t known_before = next.items.size();
    const std::size_t newly_known = before.back().unknown, known = known_before + newly_known;
    if (known >= unknown || (newly_known > 0 && level_number + 1 >= tree.levels.size()))
      refuse_damaged();
    if (known_before == 0) make_room(next, known);
    next.items.resize(known);
    next.weighed.resize(known);
    next.first_children.resize(known);
    LargeVector<std::uint32_t> children(before.back().all);
    for_blocks(walk.reached.size(), stretch, [&](std::size_t first, std::size_t last) {
      ChildNumbers at = before[first / stretch];
      for (std::size_t r = first; r < last; ++r) {
        const std::uint32_t i = walk.reached[r];
        if (walk.is_opened[r] == 0 || level.weighed[i].children == 0) continue;
        const ChildNumbers was = at;
        count(r, at);
        if (at.unknown > was.unknown) {
          level.first_children[i] = static_cast<std::uint32_t>(known_before + was.unknown);
          look_at_children(walk, level_number, i);
        }
        std::iota(children.begin() + static_cast<std::ptrdiff_t>(was.all),
                  children.begin() + static_cast<std::ptrdiff_t>(at.all), level.first_children[i]);
      }
    });
    visited_ += newly_known;
    constexpr std::uint64_t flags = 2;  // of children and loose particles
    bytes_ += newly_known * (sizeof(TreeNode) + flags + tree.fields.size() * sizeof(SampledField));
    walk.reached = std::move(children);
  }

  // For those of later passes, too: room that is not used takes no memory, and moving nodes takes
  // long.
  static void make_room(KnownLevel& level, std::size_t count) {
    constexpr std::size_t room = 4;
    level.items.reserve(room * count);
    level.weighed.reserve(room * count);
    level.first_children.reserve(room * count);
  }

  void look_at_children(Walk& walk, std::size_t level_number, std::uint32_t opened) {
    const TreePart& part = parts_[walk.part];
    const TreeLevel& of_tree = part.tree().levels[level_number];
    const KnownLevel& level = walk.levels[level_number];
    KnownLevel& next = walk.levels[level_number + 1];
    const TreeItem& item = level.items[opened];
    const std::uint8_t mask = of_tree.children[item.node];
    std::uint64_t child = of_tree.first_child(item.node);
    std::size_t to = level.first_children[opened];
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((mask >> octant & 1U) == 0) continue;
      if (child >= part.tree().levels[level_number + 1].count) refuse_damaged();
      TreeItem& looked_at = next.items[to];
      looked_at.node = static_cast<std::uint32_t>(child++);
      for (std::size_t axis = 0; axis < 3; ++axis)
        looked_at.cell[axis] = 2 * item.cell[axis] + (octant >> axis & 1U);
      next.weighed[to] = weigher_.weigh(part, looked_at, level_number + 1);
      next.first_children[to] = unknown;
      ++to;
    }
  }

  void set_drawn(const DrawnLevel& drawn, DrawnNodes& nodes) const {
    const TreePart& part = parts_[drawn.part];
    const KnownLevel& level = level_of(drawn);
    constexpr std::size_t block = 4096;
    for_blocks(drawn.kept.size(), block, [&](std::size_t first, std::size_t last) {
      for (std::size_t n = first; n < last; ++n) {
        const std::uint32_t i = drawn.kept[n];
        nodes.set_node(drawn.first_node + n, part, level.items[i], drawn.level, level.weighed[i]);
      }
    });
    for_blocks(drawn.opened.size(), block, [&](std::size_t first, std::size_t last) {
      std::uint64_t to = first == 0 ? drawn.first_particle : drawn.behind[first - 1];
      for (std::size_t n = first; n < last; ++n)
        set_particles(part, drawn.level, level.items[drawn.opened[n]].node, to, nodes);
    });
  }

  void set_particles(const TreePart& part, std::size_t level_number, std::uint32_t node,
                     std::uint64_t& to, DrawnNodes& nodes) const {
    const TreeOfType& tree = part.tree();
    const TreeLevel& level = tree.levels[level_number];
    const std::uint64_t count = level.loose[node], first = level.first_loose_particle(node);
    if (count > tree.order_count || first > tree.order_count - count) refuse_damaged();
    if (part.of_component->in_order.count > 0) {
      for (std::uint64_t loose = first; loose < first + count; ++loose)
        nodes.set_particle(to++, part.part->first_in_order + loose);
      return;
    }
    for (std::uint64_t loose = first; loose < first + count; ++loose) {
      const std::uint64_t place = tree.order[loose];
      if (place >= tree.count) refuse_damaged();
      nodes.set_particle(to++, part.part->first + place);
    }
  }

  const KnownLevel& level_of(const DrawnLevel& drawn) const {
    const auto walk = std::find_if(walks_.begin(), walks_.end(),
                                   [&drawn](const Walk& w) { return w.part == drawn.part; });
    return walk->levels[drawn.level];
  }

  std::vector<DrawnNodes> drawn_nodes() const {
    std::vector<DrawnNodes> nodes;
    for (std::size_t c = 0; c < frame_.components.size(); ++c)
      nodes.emplace_back(settings_.only_counts ? 0 : nodes_[c],
                         settings_.only_counts ? 0 : particles_[c]);
    for (const DrawnLevel& drawn : drawn_)
      set_drawn(drawn, nodes[parts_[drawn.part].component]);
    return nodes;
  }

  TreeCut finished() {
    std::vector<DrawnNodes> nodes = drawn_nodes();
    walks_.clear();
    TreeCut cut;
    cut.frame = frame_;
    cut.frame.components.clear();
    for (std::size_t c = 0; c < frame_.components.size(); ++c) {
      const DrawnComponent& component = frame_.components[c];
      if (!is_served(frame_, component)) {
        cut.frame.components.push_back(component);
        continue;
      }
      cut.frame.components.push_back(nodes[c].nodes(component));
      cut.frame.components.push_back(nodes[c].particles(component));
    }
    cut.nodes = std::accumulate(nodes_.begin(), nodes_.end(), std::uint64_t{0});
    cut.particles = std::accumulate(particles_.begin(), particles_.end(), std::uint64_t{0});
    cut.visited = visited_;
    cut.bytes = bytes_;
    for (std::size_t c = 0; c < particles_.size(); ++c) {
      if (particles_[c] > 0) cut.bytes += particles_[c] * bytes_of_particle(frame_.components[c]);
    }
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
  std::vector<Walk> walks_;
  std::vector<DrawnLevel> drawn_;
  std::vector<std::uint64_t> nodes_, particles_;  // of each component: how many are drawn
  std::uint64_t visited_ = 0, bytes_ = 0;
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
