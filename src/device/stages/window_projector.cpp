#include "device/stages/window_projector.h"

#include <utility>

#include "device/frame/splat_capacity.h"
#include "device/stages/carry_splats.h"

namespace splotchcl {
std::uint64_t splat_capacity(const StageContext& context) {
  return splat_capacity(context.plan, context.variant, context.layout, context.device.traits,
                        context.device.memory.total);
}

WindowProjector::WindowProjector(const StageContext& context, const Projector& projector,
                                 const Sorter& sorter, ParticleStore& particles)
    : context_(context),
      projector_(projector),
      sorter_(sorter),
      counter_(context, projector, particles,
               particle_chunks(context.frame, context.device.traits)),
      capacity_(splat_capacity(context)) {}

void WindowProjector::count_keys() {
  const CountedKeys counted = counter_.count({}, shift_of_all_keys);
  if (particles().too_sharp > 0) return;
  const auto count_again = [this](const KeyWindow& window, int shift) {
    return counter_.count(window, shift);
  };
  for (const KeyWindow& window : choose_windows(counted, capacity_, count_again))
    add_steps(window);
  // Clouds around the camera may be all that there is.
  if (steps_.empty()) steps_.push_back({});
}

// Splats of one key are in the order of their particles, and may be drawn chunk by chunk.
void WindowProjector::add_steps(const KeyWindow& window) {
  if (window.splats <= capacity_) {
    steps_.push_back({window, 0, counter_.chunks().size()});
    return;
  }
  for (std::size_t c = 0; c < counter_.chunks().size(); ++c) {
    const std::uint64_t most = counter_.most_splats_of(c);
    const bool has_room = !steps_.empty() && steps_.back().end_chunk == c &&
                          steps_.back().window.first == window.first &&
                          steps_.back().window.splats + most <= capacity_;
    if (!has_room) steps_.push_back({{window.first, window.end, 0}, c, c});
    steps_.back().window.splats += most;
    steps_.back().end_chunk = c + 1;
  }
}

std::uint64_t WindowProjector::end_of_step(std::size_t step) const {
  return step + 1 < steps_.size() ? steps_[step + 1].window.first : end_of_keys;
}

SortedSplats WindowProjector::next(std::size_t step, SortedSplats sorted, std::uint32_t first,
                                   const MoreSplats& more) const {
  const Step& wanted = steps_[step];
  const std::uint64_t end = end_of_step(step);
  const std::uint32_t carried = sorted.count - first;
  // What is left is put aside first: two windows have no room at one time.
  KeyedSplats left;
  if (carried > 0) {
    left = projector_.keyed_memory(carried);
    carry_splats(context_, sorted, first, left);
  }
  sorted = {std::move(left.splats), std::move(left.order), carried};
  KeyedSplats keyed = projector_.keyed_memory(
      carried + static_cast<std::uint32_t>(wanted.window.splats) + more.count(end));
  if (carried > 0) carry_splats(context_, sorted, 0, keyed);
  std::uint32_t slot = carried;
  for (std::size_t c = wanted.first_chunk; c < wanted.end_chunk; ++c) {
    if (!counter_.has_keys_in(c, wanted.window)) continue;
    slot += projector_.project_window(counter_.chunks()[c], counter_.particles_of(c), wanted.window,
                                      counter_.blocks_without(c, wanted.window), keyed, slot);
  }
  keyed.count = slot;
  more.append(end, keyed);
  return sorter_.sort(std::move(keyed));
}

}  // namespace splotchcl
