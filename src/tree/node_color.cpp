#include "tree/node_color.h"

#include <algorithm>
#include <cmath>

#include "tree/sampled_field.h"

namespace splotchcl {
namespace {

struct SampledColors {
  std::array<PaletteWay::Step, sampled_members> steps;
  std::array<float, sampled_members> factors;
};

SampledColors sampled_colors(const TreePart& part, const SampledField* sampled) {
  SampledColors colors;
  colors.steps.fill(part.palette->step(0));
  colors.factors.fill(1);
  if (part.color_places) {
    const auto values = sampled[part.part->color].all_ordered();
    for (std::size_t k = 0; k < sampled_members; ++k)
      colors.steps[k] = part.palette->step((*part.color_places)(values[k]));
  }
  if (part.intensities) {
    const auto values = sampled[part.part->intensity].all_ordered();
    for (std::size_t k = 0; k < sampled_members; ++k)
      colors.factors[k] = (*part.intensities)(values[k]);
  }
  return colors;
}

// Between neighbours lies what the eighth may hold. A step of the palette somewhere in an eighth is
// in two such spreads, and its mean variance there is a sixth of its square. Twice as much: the
// eighths at both ends reach farther, and samples of the nodes below were chosen likewise (measured
// over whole levels: 1.7 and 1.5).
constexpr float variance_of_spread = 1.0f / 6;
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
  if (part.part->color < 0 && part.part->intensity < 0) {
    color.mean = part.palette->color(0);
    return color;
  }
  const SampledColors colors =
      sampled_colors(part, level.fields + node * part.tree().fields.size());
  const std::uint8_t members = level.nodes[node].all_sampled();
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
  color.variance = static_cast<double>(variance);
  for (std::size_t c = 0; c < 3; ++c) {
    const float spread2 = std::max(0.0f, squares[c] - color.mean[c] * color.mean[c]);
    color.deviation = std::max(color.deviation, static_cast<double>(std::sqrt(spread2)));
  }
  return color;
}

}  // namespace splotchcl
