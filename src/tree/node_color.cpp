#include "tree/node_color.h"

#include <algorithm>
#include <cmath>

#include "tree/node_bytes.h"
#include "tree/sampled_field.h"

namespace splotchcl {
namespace {

struct SampledColors {
  std::array<PaletteWay::Step, sampled_members> steps;
  std::array<float, sampled_members> factors;
  float unseen2 = 0;  // squared, of the ways to members beyond all samples
};

// Squared, of the ways from the outermost samples, of these values, to the outermost members.
template <class Way>
float unseen2(const SampledField& field, const std::array<std::uint32_t, sampled_members>& values,
              const Way& way) {
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const float below = way(*least) - way(field.least_ordered());
  const float above = way(field.largest_ordered()) - way(*largest);
  return below * below + above * above;
}

SampledColors sampled_colors(const TreePart& part, const SampledField* sampled, bool are_all) {
  SampledColors colors;
  colors.factors.fill(1);
  float ways2 = 0, largest_factor = 1;
  if (part.part->color < 0) {
    colors.steps.fill(part.colors->step(0));
  } else {
    const SampledField& field = sampled[part.part->color];
    const auto values = field.all_ordered();
    const auto step = [&part](std::uint32_t ordered) { return part.colors->step(ordered); };
    std::transform(values.begin(), values.end(), colors.steps.begin(), step);
    const auto way = [&step](std::uint32_t ordered) { return step(ordered).way; };
    if (!are_all) ways2 = unseen2(field, values, way);
  }
  if (part.part->intensity >= 0) {
    const SampledField& field = sampled[part.part->intensity];
    const auto values = field.all_ordered();
    const auto factor = [&part](std::uint32_t ordered) { return part.colors->intensity(ordered); };
    std::transform(values.begin(), values.end(), colors.factors.begin(), factor);
    if (!are_all) {
      largest_factor = factor(field.largest_ordered());
      colors.unseen2 = unseen2(field, values, factor);
    }
  }
  colors.unseen2 += largest_factor * largest_factor * ways2;
  return colors;
}

// Between neighbours lies what the eighth may hold. A step of the palette somewhere in an eighth is
// in two such spreads, and its mean variance there is a sixth of its square. Twice as much: samples
// of the nodes below were chosen likewise (measured over whole levels: 1.5).
constexpr float variance_of_spread = 1.0f / 6;
// Members that lie far beyond the outermost sample are missed by chance. As much as for two
// spreads, which there would be if one of them were the outermost sample: if a node that missed
// them seemed to err by less, those would be drawn, and err alike.
constexpr float variance_of_unseen = 1.0f / 3;
float spread_around(const SampledColors& colors, std::size_t k) {
  const std::size_t before = k > 0 ? k - 1 : k;
  const std::size_t after = k + 1 < sampled_members ? k + 1 : k;
  const auto& f = colors.factors;
  return std::abs(colors.steps[after].way - colors.steps[before].way) *
             std::max({f[before], f[k], f[after]}) +
         std::abs(f[after] - f[before]);
}

}  // namespace

NodeColor node_color(const TreePart& part, const TreeLevel& level, std::uint64_t node) {
  NodeColor color;
  if (!part.colors) {
    const MeanColor& of_all = level.colors[node];
    color.mean = of_all.mean();
    color.deviation = rough_of_bits(of_all.deviation);
    color.dipole = rough_of_bits(of_all.dipole);
    return color;
  }
  if (part.part->color < 0 && part.part->intensity < 0) {
    color.mean = part.colors->step(0).color;
    return color;
  }
  const std::uint8_t members = level.nodes[node].all_sampled();
  const SampledColors colors =
      sampled_colors(part, level.fields + node * part.tree().fields.size(), members > 0);
  const std::size_t count =
      members > 0 ? std::min<std::size_t>(members, sampled_members) : sampled_members;
  const float share = 1 / static_cast<float>(count);
  color.mean = {0, 0, 0};
  std::array<float, 3> squares{};
  float variance = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = colors.steps[k].color[c] * colors.factors[k];
      color.mean[c] += value * share;
      squares[c] += value * value * share;
    }
    if (members > 0) continue;
    const float spread = spread_around(colors, k);
    variance += variance_of_spread * spread * spread * share * share;
  }
  variance += variance_of_unseen * colors.unseen2 * share * share;
  color.variance = static_cast<double>(variance);
  for (std::size_t c = 0; c < 3; ++c) {
    const float spread2 = std::max(0.0f, squares[c] - color.mean[c] * color.mean[c]);
    color.deviation = std::max(color.deviation, static_cast<double>(std::sqrt(spread2)));
  }
  return color;
}

}  // namespace splotchcl
