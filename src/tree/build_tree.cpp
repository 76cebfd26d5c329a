#include "tree/build_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/morton_keys.h"
#include "splotchcl/error.h"
#include "tree/held_particles.h"
#include "tree/level_arrays.h"
#include "tree/node_merging.h"
#include "tree/source_extent.h"
#include "tree/tree_stretch.h"

namespace splotchcl {
namespace {

constexpr int cell_level = 5;            // subtrees below it are built alone
constexpr std::size_t most_loose = 255;  // of a node
constexpr std::size_t cells = std::size_t{1} << (3 * cell_level);

// Part of the tree below one cell: a node, or too few particles for one.
struct Branch {
  std::optional<TreeMember> node;
  std::vector<TreeMember> loose;
  std::vector<std::uint32_t> places;  // of the loose ones in the snapshot

  std::size_t count = 0;  // particles
};

class TreeBuilder {
 public:
  TreeBuilder(const TreeSource& source, const TreeOptions& options,
              const std::function<void(double)>& progress)
      : source_(source),
        options_(options),
        progress_(progress),
        merged_{!source.fields.empty(), source.colors.has_value()} {
    if (source.colors) colors_.emplace(*source.colors);
  }

  TreeOfType build() {
    const SourceExtent extent = find_extent(source_);
    TreeOfType tree;
    if (extent.good > 0) {
      cube_ = cube_around(extent);
      counts_ = count_cells(source_, cube_, cell_level);
      build_cells(extent.good);
      build_top();
    }
    return finished(extent.good);
  }

 private:
  // Subtrees of one cell, by levels from cell_level on.
  struct Subtree {
    Branch branch;
    LevelsOfTree levels;
  };

  // Cells in Morton order, as many at once as may be held.
  void build_cells(std::uint64_t good) {
    const std::uint64_t most = options_.particles_at_once > 0
                                   ? options_.particles_at_once
                                   : std::max<std::uint64_t>(std::uint64_t{1} << 22, good / 16);
    branches_.resize(cells);
    std::uint64_t done = 0;
    for (std::size_t first = 0; first < cells;) {
      std::size_t last = first;
      std::uint64_t held = 0;
      while (last < cells && (held == 0 || held + counts_.particles[last] <= most))
        held += counts_.particles[last++];
      if (held > 0) build_some_cells(first, last);
      first = last;
      done += held;
      if (progress_) progress_(static_cast<double>(done) / static_cast<double>(good));
    }
  }

  void build_some_cells(std::size_t first, std::size_t last) {
    const HeldParticles held = hold(source_, cube_, cell_level, counts_, first, last);
    std::vector<std::size_t> begins(last - first + 1, 0);
    for (std::size_t cell = first; cell < last; ++cell)
      begins[cell - first + 1] = begins[cell - first] + counts_.particles[cell];
    std::vector<Subtree> subtrees(last - first);
    for_blocks(last - first, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t s = from; s < to; ++s) {
        if (begins[s] == begins[s + 1]) continue;
        subtrees[s].branch =
            branch_of(held, begins[s], begins[s + 1], cell_level, subtrees[s].levels);
      }
    });
    for (std::size_t s = 0; s < subtrees.size(); ++s) {
      for (std::size_t level = cell_level; level < levels_.size(); ++level)
        levels_[level].append(subtrees[s].levels[level]);
      branches_[first + s] = std::move(subtrees[s].branch);
    }
  }

  TreeMember member_of(const HeldParticles& held, std::size_t i) const {
    Vec3 place = {{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.a[axis] =
          (static_cast<double>(held.position[i][axis]) - cube_.lower.a[axis]) / cube_.side;
    }
    TreeMember member;
    member.moments =
        NodeMoments::of_particle(held.flux[i], place, static_cast<double>(held.h[i]) / cube_.side);
    TreeSample sample;
    const std::size_t fields = source_.fields.size();
    for (std::size_t f = 0; f < fields; ++f)
      sample.values[f] = held.values[i * fields + f];
    sample.flux = held.flux[i];
    member.samples.add(sample);
    member.samples.least = member.samples.largest = sample.values;
    if (colors_) member.colors = ColorMoments::of_particle((*colors_)(sample.values));
    return member;
  }

  // Of the particles [begin, end) in Morton order, which lie in one cell of the level.
  Branch branch_of(const HeldParticles& held, std::size_t begin, std::size_t end, int level,
                   LevelsOfTree& levels) const {
    Branch branch;
    branch.count = end - begin;
    if (branch.count < options_.least) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t particle = held.keyed[i].place;
        branch.loose.push_back(member_of(held, particle));
        branch.places.push_back(held.place[particle]);
      }
      return branch;
    }
    std::vector<Branch> parts;
    std::vector<std::size_t> octant_of_part;
    for (std::size_t from = begin; from < end && level < key_levels;) {
      const std::size_t octant = octant_at(held.keyed[from].key, level);
      const auto after = std::partition_point(
          held.keyed.begin() + static_cast<std::ptrdiff_t>(from),
          held.keyed.begin() + static_cast<std::ptrdiff_t>(end),
          [&](const KeyedParticle& p) { return octant_at(p.key, level) == octant; });
      const auto to = static_cast<std::size_t>(after - held.keyed.begin());
      parts.push_back(branch_of(held, from, to, level + 1, levels));
      octant_of_part.push_back(octant);
      from = to;
    }
    if (level == key_levels) {
      Branch all;  // in one place
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t particle = held.keyed[i].place;
        all.loose.push_back(member_of(held, particle));
        all.places.push_back(held.place[particle]);
      }
      parts.push_back(std::move(all));
      octant_of_part.push_back(0);
    }
    const auto own = static_cast<std::size_t>(level);
    if (own + 1 < levels.size()) merge_rest(parts, octant_of_part, level, levels[own + 1]);
    return joined(std::move(parts), octant_of_part, branch.count, level, levels[own]);
  }

  // Makes one node of the parts that are too few for nodes, in the level below, where they are
  // enough together and some other part is a node.
  void merge_rest(std::vector<Branch>& parts, std::vector<std::size_t>& octant_of_part, int level,
                  LevelArrays& below) const {
    std::size_t loose = 0, octant = 0, nodes_behind = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].node) {
        ++nodes_behind;
        continue;
      }
      loose += parts[p].loose.size();
      octant = octant_of_part[p];
      nodes_behind = 0;
    }
    const bool has_nodes =
        std::any_of(parts.begin(), parts.end(), [](const Branch& part) { return part.node; });
    if (!has_nodes || loose < options_.least || loose > most_loose) return;
    Branch rest;
    LevelArrays arrays;
    std::vector<Branch> nodes;
    std::vector<std::size_t> octants_of_nodes;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      rest.count += parts[p].node ? 0 : parts[p].count;
      for (TreeMember& member : parts[p].loose)
        rest.loose.push_back(std::move(member));
      arrays.order.insert(arrays.order.end(), parts[p].places.begin(), parts[p].places.end());
      if (!parts[p].node) continue;
      nodes.push_back(std::move(parts[p]));
      octants_of_nodes.push_back(octant_of_part[p]);
    }
    rest.node = merge(rest.loose, merged_);
    store(*rest.node, level, 0, loose, arrays);
    arrays.nodes.back().members |= TreeNode::rest_bit;
    below.insert_before(nodes_behind, arrays);
    nodes.push_back(std::move(rest));
    octants_of_nodes.push_back(octant);
    parts = std::move(nodes);
    octant_of_part = std::move(octants_of_nodes);
  }

  // A node of the parts in its octants.
  Branch joined(std::vector<Branch> parts, const std::vector<std::size_t>& octant_of_part,
                std::size_t count, int level, LevelArrays& arrays) const {
    std::vector<TreeMember> members;
    std::uint8_t children = 0;
    std::size_t loose = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].node) {
        children = static_cast<std::uint8_t>(children | 1U << octant_of_part[p]);
        if (parts[p].loose.empty()) members.push_back(std::move(*parts[p].node));
        // Else the rest, whose particles are sampled once.
        for (TreeMember& member : parts[p].loose)
          members.push_back(std::move(member));
        continue;
      }
      loose += parts[p].loose.size();
      for (TreeMember& member : parts[p].loose)
        members.push_back(std::move(member));
      arrays.order.insert(arrays.order.end(), parts[p].places.begin(), parts[p].places.end());
    }
    if (loose > most_loose) {
      throw UsageError(fmt::format(
          "type {}: found {} particles in one place, expected at most 255: no tree tells them "
          "apart; draw this snapshot without one",
          source_.type, loose));
    }
    Branch branch;
    branch.count = count;
    branch.node = merge(members, merged_);
    store(*branch.node, level, children, loose, arrays);
    return branch;
  }

  void store(const TreeMember& node, int level, std::uint8_t children, std::size_t loose,
             LevelArrays& arrays) const {
    arrays.nodes.push_back(stored_node(node, level));
    store_fields(node, arrays);
    if (colors_) arrays.colors.push_back(stored_color(node.colors, level));
    arrays.children.push_back(children);
    arrays.loose.push_back(static_cast<std::uint8_t>(loose));
  }

  void store_fields(const TreeMember& node, LevelArrays& arrays) const {
    const TreeSamples& sampled = node.samples;
    for (std::size_t f = 0; f < source_.fields.size(); ++f) {
      std::array<float, sampled_members> values{};
      for (std::size_t k = 0; k < sampled_members; ++k)
        values[k] = sampled.samples[std::min(k, sampled.count - 1)].values[f];
      arrays.fields.push_back(
          SampledField::of(values.data(), sampled.least[f], sampled.largest[f]));
    }
  }

  // The levels above the cells, of which all branches are known.
  void build_top() {
    std::vector<Branch> branches = std::move(branches_);
    for (int level = cell_level - 1; level >= 0; --level) {
      std::vector<Branch> parents(branches.size() / octants);
      for (std::size_t p = 0; p < parents.size(); ++p)
        parents[p] = parent_of(branches, p, level);
      branches = std::move(parents);
    }
    if (!branches.front().node) {  // so few that they are the root's loose ones
      std::vector<Branch> all;
      const std::size_t count = branches.front().count;
      all.push_back(std::move(branches.front()));
      joined(std::move(all), {0}, count, 0, levels_[0]);
    }
  }

  Branch parent_of(std::vector<Branch>& branches, std::size_t parent, int level) {
    std::vector<Branch> parts;
    std::vector<std::size_t> octant_of_part;
    std::size_t count = 0;
    for (std::size_t octant = 0; octant < octants; ++octant) {
      Branch& part = branches[parent * octants + octant];
      if (part.count == 0) continue;
      count += part.count;
      parts.push_back(std::move(part));
      octant_of_part.push_back(octant);
    }
    if (count >= options_.least)
      return joined(std::move(parts), octant_of_part, count, level,
                    levels_[static_cast<std::size_t>(level)]);
    Branch few;
    few.count = count;
    for (Branch& part : parts) {
      for (TreeMember& member : part.loose)
        few.loose.push_back(std::move(member));
      few.places.insert(few.places.end(), part.places.begin(), part.places.end());
    }
    return few;
  }

  TreeOfType finished(std::uint64_t good) {
    TreeOfType tree;
    tree.type = source_.type;
    tree.count = source_.count;
    tree.bad = source_.count - good;
    tree.weight = source_.weight;
    for (std::size_t axis = 0; axis < 3; ++axis)
      tree.origin.a[axis] = source_.origin.a[axis] + cube_.lower.a[axis];
    tree.side = cube_.side;
    for (const TreeSource::Field& field : source_.fields)
      tree.fields.push_back(field.name);
    if (source_.colors) tree.colors = source_.colors->key();
    take_levels(std::move(levels_), tree);
    return tree;
  }

  const TreeSource& source_;
  const TreeOptions& options_;
  const std::function<void(double)>& progress_;
  const MergedParts merged_;
  std::optional<ParticleColors> colors_;
  TreeCube cube_;
  CellCounts counts_;
  std::vector<Branch> branches_;  // of all cells
  LevelsOfTree levels_;
};

}  // namespace

TreeOfType build_tree(const TreeSource& source, const TreeOptions& options,
                      const std::function<void(double)>& progress) {
  if (source.count > std::numeric_limits<std::uint32_t>::max()) {
    throw UsageError(fmt::format("type {}: found {} particles, expected fewer than 2^32 for a tree",
                                 source.type, source.count));
  }
  return TreeBuilder(source, options, progress).build();
}

}  // namespace splotchcl
