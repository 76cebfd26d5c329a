#include "view/frame_sample.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "scene/hash.h"
#include "scene/particle_columns.h"

namespace splotchcl::view {
namespace {

// One of each of `count` equal runs, chosen at random from it.
std::vector<std::uint64_t> choose(std::size_t all, std::size_t count) {
  constexpr std::uint64_t seed = 1;
  std::vector<std::uint64_t> chosen(count);
  const double run = static_cast<double>(all) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::size_t>(static_cast<double>(i) * run);
    const auto end = std::min(all, static_cast<std::size_t>(static_cast<double>(i + 1) * run));
    const std::size_t length = std::max<std::size_t>(1, end - first);
    chosen[i] = std::min(all - 1, first + hash_of(hash_of(seed) + i) % length);
  }
  return chosen;
}

bool is_same(const Particles& known, const Particles& particles) {
  return known.origin == particles.origin && have_same_columns(known, particles);
}

}  // namespace

Frame FrameSampler::sample(const Frame& frame, std::uint64_t particles) {
  const std::uint64_t all = particle_count(frame);
  if (particles == 0 || all <= particles) return frame;
  ++frame_;
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
  forget_unused();
  return sampled;
}

const Particles& FrameSampler::sample_component(std::size_t component, const Particles& all,
                                                std::size_t count) {
  Kept& kept = kept_[{component, count}];
  if (!is_same(kept.source, all)) kept = {all, picked_particles(all, choose(all.count, count)), 0};
  kept.last_frame = frame_;
  return kept.sample;
}

// Levels of previews come and go, pages take turns, and each sample keeps the columns alive that it
// was taken from.
void FrameSampler::forget_unused() {
  constexpr std::uint64_t frames = 8;
  for (auto kept = kept_.begin(); kept != kept_.end();)
    kept = kept->second.last_frame + frames < frame_ ? kept_.erase(kept) : std::next(kept);
}

}  // namespace splotchcl::view
