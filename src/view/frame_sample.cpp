#include "view/frame_sample.h"

#include <algorithm>
#include <vector>

#include "scene/hash.h"

namespace splotchcl::view {
namespace {

// One of each of `count` equal runs, chosen at random from it.
std::vector<std::size_t> choose(std::size_t all, std::size_t count) {
  constexpr std::uint64_t seed = 1;
  std::vector<std::size_t> chosen(count);
  const double run = static_cast<double>(all) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::size_t>(static_cast<double>(i) * run);
    const auto end = std::min(all, static_cast<std::size_t>(static_cast<double>(i + 1) * run));
    const std::size_t length = std::max<std::size_t>(1, end - first);
    chosen[i] = std::min(all - 1, first + hash_of(hash_of(seed) + i) % length);
  }
  return chosen;
}

Column gather(const Column& column, std::size_t width, const std::vector<std::size_t>& chosen) {
  if (!column.is_array()) return column;
  std::vector<float> values;
  values.reserve(width * chosen.size());
  for (const std::size_t i : chosen) {
    const float* const first = column.data() + i * width;
    values.insert(values.end(), first, first + width);
  }
  return Column::owning(std::move(values));
}

Particles gather(const Particles& all, std::size_t count) {
  const std::vector<std::size_t> chosen = choose(all.count, count);
  Particles sample;
  sample.count = count;
  sample.origin = all.origin;
  sample.position = gather(all.position, 3, chosen);
  sample.smoothing_length = gather(all.smoothing_length, 1, chosen);
  sample.weight = gather(all.weight, 1, chosen);
  sample.color = gather(all.color, 1, chosen);
  sample.color_vector = gather(all.color_vector, 3, chosen);
  sample.intensity = gather(all.intensity, 1, chosen);
  sample.sort_field = gather(all.sort_field, 1, chosen);
  return sample;
}

// The same memory, or the same value for all. Columns that are kept keep their memory alive, so
// that no other column can have come to lie there.
bool is_same(const Column& a, const Column& b) {
  if (a.is_array() || b.is_array()) return a.data() == b.data() && a.size() == b.size();
  return a.is_uniform() == b.is_uniform() && (!a.is_uniform() || a[0] == b[0]);
}

bool is_same(const Particles& a, const Particles& b) {
  return a.count == b.count && a.origin == b.origin && is_same(a.position, b.position) &&
         is_same(a.smoothing_length, b.smoothing_length) && is_same(a.weight, b.weight) &&
         is_same(a.color, b.color) && is_same(a.color_vector, b.color_vector) &&
         is_same(a.intensity, b.intensity) && is_same(a.sort_field, b.sort_field);
}

}  // namespace

Frame FrameSampler::sample(const Frame& frame, std::uint64_t particles) {
  const std::uint64_t all = particle_count(frame);
  if (particles == 0 || all <= particles) return frame;
  Frame sampled = frame;
  const double share = static_cast<double>(particles) / static_cast<double>(all);
  for (std::size_t i = 0; i < sampled.components.size(); ++i) {
    DrawnComponent& component = sampled.components[i];
    const std::size_t count = component.particles.count;
    if (count == 0) continue;
    const auto some =
        std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
    component.particles = sample_component(i, frame.components[i].particles, some);
    const double stands_for = static_cast<double>(count) / static_cast<double>(some);
    component.reference_column /= stands_for;
    component.particles_per_drawn *= stands_for;
  }
  return sampled;
}

const Particles& FrameSampler::sample_component(std::size_t component, const Particles& all,
                                                std::size_t count) {
  Kept& kept = kept_[{component, count}];
  if (!is_same(kept.source, all)) kept = {all, gather(all, count)};
  return kept.sample;
}

}  // namespace splotchcl::view
