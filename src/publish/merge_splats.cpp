#include "publish/merge_splats.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace splotchcl {
namespace {

using Member = std::vector<LightSplat>::iterator;

// Splats next to each other in memory, and the one that can stand for them.
struct Group {
  Member begin, end;
  LightSplat merged;
  double error = 0;
  std::size_t widest_axis = 0;
  float middle = 0;  // of their places along that axis

  bool operator<(const Group& other) const {
    return error != other.error ? error < other.error : begin < other.begin;
  }
};

// What hides counts less than what shines: stars are far brighter than white, and with as much
// weight pictures are three times as far from those of all particles.
constexpr float weight_of_depth = 0.1F;

// pi times it is all of its light in a picture, where a length is a pixel, and what it takes from
// light behind it.
double flux(const LightSplat& splat) {
  const auto& [light, depth] = std::tie(splat.light, splat.depth);
  return static_cast<double>(light[0] + light[1] + light[2] +
                             weight_of_depth * (depth[0] + depth[1] + depth[2])) *
         static_cast<double>(splat.sigma) * static_cast<double>(splat.sigma);
}

Group group_of(Member begin, Member end) {
  Group group;
  group.begin = begin;
  group.end = end;
  if (end - begin == 1) {
    group.merged = *begin;
    return group;
  }
  double total = 0, sigma2 = 0, sigma4 = 0, mean[3] = {}, light[3] = {}, depth[3] = {}, spread = 0;
  std::array<float, 3> lower = begin->place, upper = begin->place;
  for (Member member = begin; member != end; ++member) {
    const double of_member = flux(*member);
    const double area = static_cast<double>(member->sigma) * static_cast<double>(member->sigma);
    total += of_member;
    sigma2 += of_member * area;
    sigma4 += of_member * area * area;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mean[axis] += of_member * static_cast<double>(member->place[axis]);
      light[axis] += static_cast<double>(member->light[axis]) * area;
      depth[axis] += static_cast<double>(member->depth[axis]) * area;
      lower[axis] = std::min(lower[axis], member->place[axis]);
      upper[axis] = std::max(upper[axis], member->place[axis]);
    }
  }
  for (double& coordinate : mean)
    coordinate /= total;
  for (Member member = begin; member != end; ++member) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(member->place[axis]) - mean[axis];
      spread += flux(*member) * d * d;
    }
  }
  // exp(-d^2 / sigma^2) has a variance of sigma^2 / 2 along each axis.
  const double between = 2 * spread / (3 * total), all = sigma2 / total + between;
  group.merged.sigma = static_cast<float>(std::sqrt(all));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    group.merged.place[axis] = static_cast<float>(mean[axis]);
    group.merged.light[axis] = static_cast<float>(light[axis] / all);
    group.merged.depth[axis] = static_cast<float>(depth[axis] / all);
    if (upper[axis] - lower[axis] > upper[group.widest_axis] - lower[group.widest_axis])
      group.widest_axis = axis;
  }
  group.middle =
      lower[group.widest_axis] + (upper[group.widest_axis] - lower[group.widest_axis]) / 2;
  const double uneven =
      std::sqrt(std::max(0.0, sigma4 / total - sigma2 / total * (sigma2 / total)));
  const double lost = (between + uneven) / all;
  // Of splats that are alike roundings are left.
  group.error = lost > 1e-6 ? std::sqrt(total) * lost : 0;
  return group;
}

// In the middle of where they lie; of places that a float cannot tell apart half of them.
Member split(const Group& group) {
  const std::size_t axis = group.widest_axis;
  const Member second = std::partition(group.begin, group.end, [&](const LightSplat& splat) {
    return splat.place[axis] <= group.middle;
  });
  if (second != group.begin && second != group.end) return second;
  return group.begin + (group.end - group.begin) / 2;
}

}  // namespace

std::vector<LightSplat> merge_splats(std::vector<LightSplat> splats, std::size_t most) {
  if (splats.size() <= most || most == 0) return splats;
  std::priority_queue<Group> groups;
  groups.push(group_of(splats.begin(), splats.end()));
  while (groups.size() < most && groups.top().error > 0) {
    const Group group = groups.top();
    groups.pop();
    const Member second = split(group);
    groups.push(group_of(group.begin, second));
    groups.push(group_of(second, group.end));
  }
  std::vector<std::pair<Member, LightSplat>> in_order;
  in_order.reserve(groups.size());
  for (; !groups.empty(); groups.pop())
    in_order.emplace_back(groups.top().begin, groups.top().merged);
  // Neighbors next to each other pack better.
  std::sort(in_order.begin(), in_order.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<LightSplat> merged;
  merged.reserve(in_order.size());
  for (const auto& [member, splat] : in_order)
    merged.push_back(splat);
  return merged;
}

}  // namespace splotchcl
