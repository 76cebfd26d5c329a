#include "tree/node_merging.h"

#include <algorithm>
#include <cmath>

#include "scene/hash.h"
#include "tree/node_bytes.h"

namespace splotchcl {
namespace {

// Members without flux widen only where the node reaches.
NodeMoments merged_with_dark_ones(const std::vector<const NodeMoments*>& parts,
                                  const std::vector<TreeMember>& members) {
  double flux = 0;
  for (const NodeMoments* const part : parts)
    flux += part->flux;
  if (flux > 0) return NodeMoments::merged(parts);
  std::vector<NodeMoments> equal;
  for (const TreeMember& member : members) {
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

// In [0, 1), of the node and the eighth alone.
double random_of(const NodeMoments& moments, std::size_t k) {
  WordHash hash;
  for (const double number : moments.centroid.a)
    hash.add(number);
  hash.add(static_cast<std::uint64_t>(k));
  return static_cast<double>(hash_of(hash.value()) >> 11) * 0x1p-53;
}

// Where in the k-th eighth. Neighbors' places mirror each other, so that what rises evenly from
// the one to the other has its mean.
double place_in_eighth(const NodeMoments& moments, std::size_t k) {
  const double random = random_of(moments, k / 2);
  return k % 2 == 0 ? random : 1 - random;
}

bool are_alike_in_flux(const std::vector<TreeSample>& samples) {
  constexpr double alike = 1e-4;
  const auto [least, largest] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const TreeSample& a, const TreeSample& b) { return a.flux < b.flux; });
  return largest->flux - least->flux <= alike * largest->flux;
}

void take_ranges(const std::vector<TreeMember>& members, TreeSamples& samples) {
  samples.least = members.front().samples.least;
  samples.largest = members.front().samples.largest;
  for (const TreeMember& member : members) {
    for (std::size_t f = 0; f < most_fields; ++f) {
      samples.least[f] = std::min(samples.least[f], member.samples.least[f]);
      samples.largest[f] = std::max(samples.largest[f], member.samples.largest[f]);
    }
  }
}

// Up to eight members that are alike in flux. Of others eight that stand for an eighth of the flux
// each, in the order of the first field: the one in whose share a random place of each eighth lies,
// so that any function of the fields has the members' mean.
TreeSamples resampled(const std::vector<TreeMember>& members, const NodeMoments& moments) {
  std::vector<TreeSample> all;
  bool are_all = true;
  for (const TreeMember& member : members) {
    const auto* const first = member.samples.samples.data();
    all.insert(all.end(), first, first + member.samples.count);
    are_all = are_all && member.samples.are_all;
  }
  std::stable_sort(all.begin(), all.end(), [](const TreeSample& a, const TreeSample& b) {
    return a.values[0] < b.values[0];
  });
  TreeSamples chosen;
  take_ranges(members, chosen);
  chosen.are_all = are_all && all.size() <= sampled_members && are_alike_in_flux(all);
  if (chosen.are_all) {
    for (const TreeSample& sample : all)
      chosen.add(sample);
    return chosen;
  }
  double total = 0;
  for (const TreeSample& sample : all)
    total += sample.flux;
  if (!(total > 0)) {
    total = 0;
    for (TreeSample& sample : all)
      total += sample.flux = 1;
  }
  double before = 0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < sampled_members; ++k) {
    const double at =
        (static_cast<double>(k) + place_in_eighth(moments, k)) * total / sampled_members;
    while (next + 1 < all.size() && before + all[next].flux <= at)
      before += all[next++].flux;
    TreeSample sample = all[next];
    sample.flux = moments.flux / sampled_members;
    chosen.add(sample);
  }
  return chosen;
}

ColorMoments merged_colors(const std::vector<TreeMember>& members, const NodeMoments& moments) {
  ColorMoments sum;
  for (const TreeMember& member : members) {
    const double share = moments.flux > 0 ? member.moments.flux / moments.flux
                                          : 1 / static_cast<double>(members.size());
    const ColorMoments& part = member.colors;
    for (std::size_t c = 0; c < 3; ++c) {
      sum.mean[c] += share * part.mean[c];
      sum.square[c] += share * part.square[c];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double away = member.moments.centroid.a[axis] - moments.centroid.a[axis];
        sum.dipole[c][axis] += share * (part.dipole[c][axis] + part.mean[c] * away);
      }
    }
  }
  return sum;
}

}  // namespace

ColorMoments ColorMoments::of_particle(const std::array<float, 3>& color) {
  ColorMoments moments;
  for (std::size_t c = 0; c < 3; ++c) {
    moments.mean[c] = static_cast<double>(color[c]);
    moments.square[c] = moments.mean[c] * moments.mean[c];
  }
  return moments;
}

TreeMember merge(const std::vector<TreeMember>& members, const MergedParts& wanted) {
  std::vector<const NodeMoments*> parts;
  for (const TreeMember& member : members) {
    if (member.moments.flux > 0) parts.push_back(&member.moments);
  }
  if (parts.empty()) {  // dark ones, which lie anywhere in the cell
    for (const TreeMember& member : members)
      parts.push_back(&member.moments);
  }
  TreeMember node;
  node.moments = merged_with_dark_ones(parts, members);
  if (wanted.samples) node.samples = resampled(members, node.moments);
  if (wanted.colors) node.colors = merged_colors(members, node.moments);
  return node;
}

TreeNode stored_node(const TreeMember& merged, int level) {
  const NodeMoments& moments = merged.moments;
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
  const auto all = static_cast<std::uint8_t>(merged.samples.are_all ? merged.samples.count : 0);
  node.members =
      static_cast<std::uint8_t>(narrow_bits(moments.narrowness()) << TreeNode::narrow_shift | all);
  node.reach = rough_bits(1.05 * moments.reach / cell);  // more than is rounded off
  node.flux = static_cast<float>(moments.flux);
  return node;
}

MeanColor stored_color(const ColorMoments& colors, int level) {
  double deviation2 = 0, dipole2 = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& [x, y, z] = colors.dipole[c];
    deviation2 = std::max(deviation2, colors.square[c] - colors.mean[c] * colors.mean[c]);
    dipole2 = std::max(dipole2, x * x + y * y + z * z);
  }
  return MeanColor::of(colors.mean, std::sqrt(deviation2), std::sqrt(dipole2) / std::exp2(-level));
}

}  // namespace splotchcl
