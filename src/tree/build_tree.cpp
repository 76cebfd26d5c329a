#include "tree/build_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "splotchcl/error.h"
#include "tree/node_bytes.h"
#include "tree/node_moments.h"

namespace splotchcl {
namespace {

constexpr int key_levels = 21;
constexpr int cell_level = 5;  // subtrees below it are built alone
constexpr std::size_t cells = std::size_t{1} << (3 * cell_level);
constexpr std::size_t octants = 8;

using Values = std::array<float, most_fields>;

// A member that stands for others, with their flux.
struct Sample {
  Values values{};
  double flux = 0;
};

struct Samples {
  std::array<Sample, sampled_members> samples{};
  std::size_t count = 0;

  void add(const Sample& sample) { samples[count++] = sample; }
};

// A particle, or a node of which the parent is made.
struct Member {
  NodeMoments moments;
  Samples samples;
};

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
using Levels = std::array<LevelArrays, TreeOfType::levels_at_most>;

// Part of the tree below one cell: a node, or too few particles for one.
struct Branch {
  std::optional<Member> node;
  std::vector<Member> loose;
  std::vector<std::uint32_t> places;  // of the loose ones in the snapshot

  std::size_t count = 0;  // particles
};

struct Cube {
  Vec3 lower = {{0, 0, 0}};  // of the positions as their column has them
  double side = 1;
};

struct KeyedParticle {
  std::uint64_t key = 0;
  std::uint32_t place = 0;  // in the snapshot, or among those held
};

// Every third bit.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffffU;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

// 63 bits: of three axes from the highest on, x the lowest of each triple.
std::uint64_t key_of(const std::array<double, 3>& place) {
  std::uint64_t key = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(place[axis] * 0x1p21, 0.0, 0x1p21 - 1);
    key |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return key;
}

std::size_t octant_at(std::uint64_t key, int level) {
  return static_cast<std::size_t>(key >> (3 * (key_levels - 1 - level))) & (octants - 1);
}

std::size_t cell_of(std::uint64_t key) {
  return static_cast<std::size_t>(key >> (3 * (key_levels - cell_level)));
}

// A stretch of the source's columns.
class Stretch {
 public:
  Stretch(const TreeSource& source, std::size_t begin, std::size_t end)
      : position_(source.position, 3 * begin, 3 * end),
        length_(source.smoothing_length, begin, end),
        has_weights_(!source.weights.is_absent()),
        weight_(source.weights, begin, end),
        model_(source.weight) {
    fields_.reserve(source.fields.size());
    for (const TreeSource::Field& field : source.fields)
      fields_.push_back(std::make_unique<ColumnStretch>(field.values, begin, end));
  }

  bool is_good(std::size_t i) const {
    const float at[3] = {position_[3 * i], position_[3 * i + 1], position_[3 * i + 2]};
    if (!is_finite_position(at) || !is_smoothing_length(length_[i])) return false;
    const double flux = this->flux(i);
    if (!std::isfinite(flux) || flux < 0) return false;
    return std::all_of(fields_.begin(), fields_.end(),
                       [i](const auto& field) { return std::isfinite((*field)[i]); });
  }
  std::array<double, 3> place(std::size_t i, const Cube& cube) const {
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (static_cast<double>(position_[3 * i + axis]) - cube.lower.a[axis]) / cube.side;
    return place;
  }
  float position(std::size_t i, std::size_t axis) const { return position_[3 * i + axis]; }
  double h(std::size_t i) const { return static_cast<double>(length_[i]); }
  double flux(std::size_t i) const {
    const double weight = has_weights_ ? static_cast<double>(weight_[i]) : 1;
    if (model_ == WeightModel::mass) return weight;
    return model_ == WeightModel::constant ? weight * h(i) : weight * h(i) * h(i) * h(i);
  }
  Values values(std::size_t i) const {
    Values values{};
    for (std::size_t f = 0; f < fields_.size(); ++f)
      values[f] = (*fields_[f])[i];
    return values;
  }

 private:
  ColumnStretch position_, length_;
  bool has_weights_;
  ColumnStretch weight_;
  WeightModel model_;
  std::vector<std::unique_ptr<ColumnStretch>> fields_;
};

// Calls look(stretch, begin, end) for all of the source, on all cores.
template <class Look>
void for_source(const TreeSource& source, const Look& look) {
  const std::size_t count = static_cast<std::size_t>(source.count);
  for_blocks(ceil_divide(count, streamed_particles), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const std::size_t begin = s * streamed_particles;
      const std::size_t end = std::min(count, begin + streamed_particles);
      look(Stretch(source, begin, end), begin, end);
    }
  });
}

struct Extent {
  std::array<float, 3> lower, upper;
  std::uint64_t good = 0;

  Extent() {
    lower.fill(std::numeric_limits<float>::infinity());
    upper.fill(-std::numeric_limits<float>::infinity());
  }
  void add(const Extent& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
    good += other.good;
  }
};

Extent find_extent(const TreeSource& source) {
  Extent all;
  std::mutex of_all;
  for_source(source, [&](const Stretch& stretch, std::size_t begin, std::size_t end) {
    Extent own;
    for (std::size_t i = begin; i < end; ++i) {
      if (!stretch.is_good(i)) continue;
      ++own.good;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        own.lower[axis] = std::min(own.lower[axis], stretch.position(i, axis));
        own.upper[axis] = std::max(own.upper[axis], stretch.position(i, axis));
      }
    }
    const std::lock_guard lock(of_all);
    all.add(own);
  });
  return all;
}

// A little larger than the particles' box, so that all lie within.
Cube cube_around(const Extent& extent) {
  Cube cube;
  double widest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lower = static_cast<double>(extent.lower[axis]);
    const double upper = static_cast<double>(extent.upper[axis]);
    cube.lower.a[axis] = lower;
    widest = std::max({widest, upper - lower, 1e-6 * std::max(std::abs(lower), std::abs(upper))});
  }
  cube.side = widest > 0 ? widest * (1 + 1e-9) : 1;
  return cube;
}

// Of some cells, all their particles in Morton order.
struct HeldParticles {
  std::vector<KeyedParticle> keyed;  // place: among the arrays below
  std::vector<std::uint32_t> place;  // in the snapshot
  std::vector<std::array<float, 3>> position;
  std::vector<float> h;
  std::vector<double> flux;
  std::vector<float> values;  // of all fields
};

// Stable, by eight bits at a time from the lowest that differ.
void sort_by_key(std::vector<KeyedParticle>& particles) {
  std::uint64_t any = 0, all = ~std::uint64_t{0};
  for (const KeyedParticle& particle : particles) {
    any |= particle.key;
    all &= particle.key;
  }
  const std::uint64_t differing = any & ~all;
  std::vector<KeyedParticle> sorted(particles.size());
  constexpr int digit = 11;
  for (int shift = 0; shift < 3 * key_levels; shift += digit) {
    const std::uint64_t mask = (std::uint64_t{1} << digit) - 1;
    if ((differing >> shift & mask) == 0) continue;
    std::vector<std::size_t> next((std::size_t{1} << digit) + 1, 0);
    for (const KeyedParticle& particle : particles)
      ++next[(particle.key >> shift & mask) + 1];
    for (std::size_t d = 1; d < next.size(); ++d)
      next[d] += next[d - 1];
    for (const KeyedParticle& particle : particles)
      sorted[next[particle.key >> shift & mask]++] = particle;
    particles.swap(sorted);
  }
}

class TreeBuilder {
 public:
  TreeBuilder(const TreeSource& source, const TreeOptions& options,
              const std::function<void(double)>& progress)
      : source_(source), options_(options), progress_(progress) {}

  TreeOfType build() {
    const Extent extent = find_extent(source_);
    TreeOfType tree;
    if (extent.good > 0) {
      cube_ = cube_around(extent);
      count_cells();
      build_cells(extent.good);
      build_top();
    }
    return finished(extent.good);
  }

 private:
  // Subtrees of one cell, by levels from cell_level on.
  struct Subtree {
    Branch branch;
    Levels levels;
  };

  void count_cells() {
    cell_counts_.assign(cells, 0);
    std::mutex of_counts;
    for_source(source_, [&](const Stretch& stretch, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> own(cells, 0);
      for (std::size_t i = begin; i < end; ++i) {
        if (stretch.is_good(i)) ++own[cell_of(key_of(stretch.place(i, cube_)))];
      }
      const std::lock_guard lock(of_counts);
      for (std::size_t cell = 0; cell < cells; ++cell)
        cell_counts_[cell] += own[cell];
    });
  }

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
      while (last < cells && (held == 0 || held + cell_counts_[last] <= most))
        held += cell_counts_[last++];
      if (held > 0) build_some_cells(first, last, held);
      first = last;
      done += held;
      if (progress_) progress_(static_cast<double>(done) / static_cast<double>(good));
    }
  }

  void build_some_cells(std::size_t first, std::size_t last, std::uint64_t count) {
    const HeldParticles held = hold(first, last, count);
    std::vector<std::size_t> begins(last - first + 1, 0);
    for (std::size_t cell = first; cell < last; ++cell)
      begins[cell - first + 1] = begins[cell - first] + cell_counts_[cell];
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

  // In the order of the snapshot, however many threads look.
  HeldParticles hold(std::size_t first, std::size_t last, std::uint64_t count) {
    const std::size_t stretches =
        ceil_divide(static_cast<std::size_t>(source_.count), streamed_particles);
    std::vector<std::vector<KeyedParticle>> found(stretches);
    for_source(source_, [&](const Stretch& stretch, std::size_t begin, std::size_t end) {
      std::vector<KeyedParticle>& own = found[begin / streamed_particles];
      for (std::size_t i = begin; i < end; ++i) {
        if (!stretch.is_good(i)) continue;
        const std::uint64_t key = key_of(stretch.place(i, cube_));
        const std::size_t cell = cell_of(key);
        if (cell >= first && cell < last) own.push_back({key, static_cast<std::uint32_t>(i)});
      }
    });
    std::vector<std::size_t> begins(stretches + 1, 0);
    for (std::size_t s = 0; s < stretches; ++s)
      begins[s + 1] = begins[s] + found[s].size();
    HeldParticles held;
    const auto size = static_cast<std::size_t>(count);
    held.keyed.resize(size);
    held.place.resize(size);
    held.position.resize(size);
    held.h.resize(size);
    held.flux.resize(size);
    held.values.resize(size * source_.fields.size());
    for_source(source_, [&](const Stretch& stretch, std::size_t begin, std::size_t) {
      const std::size_t s = begin / streamed_particles;
      for (std::size_t f = 0; f < found[s].size(); ++f) {
        const std::size_t to = begins[s] + f, i = found[s][f].place;
        held.keyed[to] = {found[s][f].key, static_cast<std::uint32_t>(to)};
        held.place[to] = found[s][f].place;
        for (std::size_t axis = 0; axis < 3; ++axis)
          held.position[to][axis] = stretch.position(i, axis);
        held.h[to] = static_cast<float>(stretch.h(i));
        held.flux[to] = stretch.flux(i);
        const Values values = stretch.values(i);
        std::copy_n(values.begin(), source_.fields.size(),
                    held.values.begin() + static_cast<std::ptrdiff_t>(to * source_.fields.size()));
      }
    });
    sort_by_key(held.keyed);
    return held;
  }

  Member member_of(const HeldParticles& held, std::size_t i) const {
    Vec3 place = {{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.a[axis] =
          (static_cast<double>(held.position[i][axis]) - cube_.lower.a[axis]) / cube_.side;
    }
    Member member;
    member.moments =
        NodeMoments::of_particle(held.flux[i], place, static_cast<double>(held.h[i]) / cube_.side);
    Sample sample;
    const std::size_t fields = source_.fields.size();
    for (std::size_t f = 0; f < fields; ++f)
      sample.values[f] = held.values[i * fields + f];
    sample.flux = held.flux[i];
    member.samples.add(sample);
    return member;
  }

  // Of the particles [begin, end) in Morton order, which lie in one cell of the level.
  Branch branch_of(const HeldParticles& held, std::size_t begin, std::size_t end, int level,
                   Levels& levels) const {
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
    return joined(std::move(parts), octant_of_part, branch.count, level,
                  levels[static_cast<std::size_t>(level)]);
  }

  // A node of the parts in its octants.
  Branch joined(std::vector<Branch> parts, const std::vector<std::size_t>& octant_of_part,
                std::size_t count, int level, LevelArrays& arrays) const {
    std::vector<Member> members;
    std::uint8_t children = 0;
    std::size_t loose = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].node) {
        children = static_cast<std::uint8_t>(children | 1U << octant_of_part[p]);
        members.push_back(std::move(*parts[p].node));
        continue;
      }
      loose += parts[p].loose.size();
      for (Member& member : parts[p].loose)
        members.push_back(std::move(member));
      arrays.order.insert(arrays.order.end(), parts[p].places.begin(), parts[p].places.end());
    }
    if (loose > 255) {
      throw UsageError(fmt::format(
          "type {}: found {} particles in one place, expected at most 255: no tree tells them "
          "apart; draw this snapshot without one",
          source_.type, loose));
    }
    Branch branch;
    branch.count = count;
    branch.node = merge(members);
    arrays.nodes.push_back(stored(branch.node->moments, level));
    store_fields(*branch.node, arrays);
    arrays.children.push_back(children);
    arrays.loose.push_back(static_cast<std::uint8_t>(loose));
    return branch;
  }

  Member merge(const std::vector<Member>& members) const {
    std::vector<const NodeMoments*> parts;
    for (const Member& member : members) {
      if (member.moments.flux > 0) parts.push_back(&member.moments);
    }
    if (parts.empty()) {  // dark ones, which lie anywhere in the cell
      for (const Member& member : members)
        parts.push_back(&member.moments);
    }
    Member node;
    node.moments = merged_with_dark_ones(parts, members);
    if (!source_.fields.empty()) node.samples = resampled(members, node.moments);
    return node;
  }

  // Members without flux widen only where the node reaches.
  static NodeMoments merged_with_dark_ones(const std::vector<const NodeMoments*>& parts,
                                           const std::vector<Member>& members) {
    double flux = 0;
    for (const NodeMoments* const part : parts)
      flux += part->flux;
    if (flux > 0) return NodeMoments::merged(parts);
    std::vector<NodeMoments> equal;
    for (const Member& member : members) {
      equal.push_back(member.moments);
      equal.back().flux = 1;
    }
    std::vector<const NodeMoments*> pointers;
    for (const NodeMoments& part : equal)
      pointers.push_back(&part);
    NodeMoments dark = NodeMoments::merged(pointers);
    dark.flux = 0;
    return dark;
  }

  // Eight that stand for an eighth of the flux each, in the order of the first field: the one in
  // whose share a random place of each eighth lies, so that any function of the fields has the
  // members' mean.
  Samples resampled(const std::vector<Member>& members, const NodeMoments& moments) const {
    std::vector<Sample> all;
    for (const Member& member : members) {
      const auto* const first = member.samples.samples.data();
      all.insert(all.end(), first, first + member.samples.count);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Sample& a, const Sample& b) { return a.values[0] < b.values[0]; });
    double total = 0;
    for (const Sample& sample : all)
      total += sample.flux;
    if (!(total > 0)) {
      total = 0;
      for (Sample& sample : all)
        total += sample.flux = 1;
    }
    Samples chosen;
    double before = 0;
    std::size_t next = 0;
    for (std::size_t k = 0; k < sampled_members; ++k) {
      const double at = (static_cast<double>(k) + random_of(moments, k)) * total / sampled_members;
      while (next + 1 < all.size() && before + all[next].flux <= at)
        before += all[next++].flux;
      Sample sample = all[next];
      sample.flux = moments.flux / sampled_members;
      chosen.add(sample);
    }
    return chosen;
  }

  // In [0, 1), of the node and the eighth alone.
  static double random_of(const NodeMoments& moments, std::size_t k) {
    WordHash hash;
    for (const double number : moments.centroid.a)
      hash.add(number);
    hash.add(static_cast<std::uint64_t>(k));
    return static_cast<double>(hash_of(hash.value()) >> 11) * 0x1p-53;
  }

  TreeNode stored(const NodeMoments& moments, int level) const {
    TreeNode node;
    const double cell = std::exp2(-level);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = moments.centroid.a[axis] / cell;
      const double part = place - std::floor(place);
      node.place[axis] =
          static_cast<std::uint16_t>(std::clamp(std::floor(part * 0x1p16), 0.0, 65535.0));
    }
    node.deviation = length_bits(std::sqrt(moments.variance()));
    node.size = length_bits(std::sqrt(moments.h2));
    const NodeShape shape = shape_of(moments, usual_deviation_per_h);
    node.third = rough_bits(std::cbrt(shape.third) / cell);
    node.fourth = rough_bits(std::sqrt(std::sqrt(shape.fourth)) / cell);
    node.uneven = rough_bits(std::sqrt(shape.uneven) / cell);
    node.widest = wide_bits(moments.widest);
    node.reach = rough_bits(1.05 * moments.reach / cell);  // more than is rounded off
    node.flux = static_cast<float>(moments.flux);
    return node;
  }

  void store_fields(const Member& node, LevelArrays& arrays) const {
    for (std::size_t f = 0; f < source_.fields.size(); ++f) {
      std::array<float, sampled_members> values{};
      for (std::size_t k = 0; k < sampled_members; ++k)
        values[k] = node.samples.samples[k].values[f];
      arrays.fields.push_back(SampledField::of(values.data()));
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
      for (Member& member : part.loose)
        few.loose.push_back(std::move(member));
      few.places.insert(few.places.end(), part.places.begin(), part.places.end());
    }
    return few;
  }

  // All memory of a tree that is not in a file.
  struct Memory {
    Levels levels;
    std::array<std::vector<std::uint64_t>, TreeOfType::levels_at_most> first_children, first_loose;
    std::vector<std::uint32_t> order;
  };

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
    const auto memory = std::make_shared<Memory>();
    memory->levels = std::move(levels_);
    for (std::size_t l = 0; l < memory->levels.size() && !memory->levels[l].nodes.empty(); ++l)
      tree.levels.push_back(level_of(*memory, l));
    tree.order = memory->order.data();
    tree.order_count = memory->order.size();
    tree.owner = memory;
    return tree;
  }

  static TreeLevel level_of(Memory& memory, std::size_t l) {
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
    level.children = arrays.children.data();
    level.loose = arrays.loose.data();
    level.first_children = memory.first_children[l].data();
    level.first_loose = memory.first_loose[l].data();
    return level;
  }

  const TreeSource& source_;
  const TreeOptions& options_;
  const std::function<void(double)>& progress_;
  Cube cube_;
  std::vector<std::uint64_t> cell_counts_;
  std::vector<Branch> branches_;  // of all cells
  Levels levels_;
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
