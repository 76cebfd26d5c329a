#include "publish/light_splats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <tuple>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/particle_rules.h"
#include "scene/plan/light_structure.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr std::size_t particles_at_once = 1 << 15;

// What the scene's matter does to light, per unit of its column.
struct Matter {
  double emitted = 0, absorbed = 0;
};

// `own` and `of_palette` are what the particle and the absorption palette say, and `column` how
// much of it there is.
Matter matter_of(const DrawnComponent& component, double own, double of_palette, double column) {
  const double emitted = component.brightness * own;
  switch (component.absorption.kind) {
    case Absorption::Kind::none:
      break;
    case Absorption::Kind::as_emission:
      return {emitted, component.brightness * of_palette};
    case Absorption::Kind::factor:
      return {emitted, component.absorption.factor * of_palette};
    case Absorption::Kind::gray: {
      const double amplitude = emitted * column;
      const double part = amplitude > 0 ? amplitude / (amplitude + component.absorption.factor) : 0;
      return {emitted * part, emitted};
    }
  }
  return {emitted, 0};
}

LightSplat splat_of(const DrawnComponent& component, std::size_t i, double kernel_width,
                    const Vec3& origin, bool ordered) {
  const Particles& particles = component.particles;
  const double h = component.size_factor * static_cast<double>(particles.smoothing_length[i]);
  const double sigma = kernel_width * h;
  const double weight =
      particles.weight.is_absent() ? 1.0 : static_cast<double>(particles.weight[i]);
  double column = central_column(component.weight, weight, h, sigma) / component.reference_column;
  if (!particles.intensity.is_absent())
    column *= normalized(static_cast<double>(particles.intensity[i]), component.intensity);
  const double place = particles.color.is_absent()
                           ? 0.0
                           : normalized(static_cast<double>(particles.color[i]), component.color);
  const Palette& palette = component.palette;
  const std::array<double, 3> emission = sample_knots(palette.emission, place);
  const std::array<double, 3> absorption =
      sample_knots(palette.has_own_absorption() ? palette.absorption : palette.emission, place);
  LightSplat splat;
  splat.sigma = static_cast<float>(sigma);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    splat.place[axis] = static_cast<float>((particles.origin.a[axis] - origin.a[axis]) +
                                           static_cast<double>(particles.position[3 * i + axis]));
    const double own = particles.color_vector.is_absent()
                           ? 1.0
                           : static_cast<double>(particles.color_vector[3 * i + axis]);
    const double of_palette = absorption[axis] * (palette.has_own_absorption() ? 1.0 : own);
    const Matter matter = matter_of(component, emission[axis] * own, of_palette, column);
    splat.light[axis] = static_cast<float>(matter.emitted * column);
    if (ordered) splat.depth[axis] = static_cast<float>(matter.absorbed * column);
  }
  return splat;
}

}  // namespace

Vec3 look_at_point(const CameraFrame& camera) {
  Vec3 point = camera.position;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.a[axis] += camera.look_at_distance * camera.forward.a[axis];
  return point;
}

bool is_ordered(const Frame& frame) {
  return find_light_structure(frame).light == LightPlan::ordered;
}

std::vector<LightSplat> light_splats(const Frame& frame) {
  const Vec3 origin = look_at_point(frame.camera);
  const bool ordered = is_ordered(frame);
  std::vector<LightSplat> splats;
  splats.reserve(particle_count(frame));
  for (const DrawnComponent& component : frame.components) {
    const std::size_t first = splats.size();
    splats.resize(first + component.particles.count);
    for_blocks(component.particles.count, particles_at_once,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   // Those that are left out have no width.
                   if (is_bad(component.particles, i)) continue;
                   splats[first + i] = splat_of(component, i, frame.kernel.width, origin, ordered);
                 }
               });
  }
  splats.erase(
      std::remove_if(splats.begin(), splats.end(),
                     [](const LightSplat& splat) {
                       const auto& [red, green, blue] = splat.light;
                       const auto& [of_red, of_green, of_blue] = splat.depth;
                       const float most = std::max({red, green, blue, of_red, of_green, of_blue});
                       return !(splat.sigma > 0) || !(most > 0);
                     }),
      splats.end());
  return splats;
}

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
