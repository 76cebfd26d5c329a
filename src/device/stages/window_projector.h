#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "device/frame/chunks.h"
#include "device/frame/key_windows.h"
#include "device/frame/particle_store.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "device/stages/key_counter.h"
#include "device/stages/projector.h"
#include "device/stages/sorter.h"

namespace splotchcl {

// In the memory of the device (splat_capacity.h).
std::uint64_t splat_capacity(const StageContext& context);

// The splats of an ordered frame that has more of them than there is room for: window by window of
// their keys, nearest first. A pass over the particles counts keys; then each window takes a pass
// over the blocks of particles that have splats in it.
class WindowProjector {
 public:
  // All of them outlive it.
  WindowProjector(const StageContext& context, const Projector& projector, const Sorter& sorter,
                  ParticleStore& particles);

  // First of all; waits for the device. Where particles are too sharp there is nothing to draw.
  void count_keys();
  const ParticleCounts& particles() const { return counter_.particles(); }
  std::uint32_t left_out() const { return counter_.left_out(); }  // blocks out of view
  std::size_t steps() const { return steps_.size(); }

  // What of `sorted` is left from place `first` on, and behind it the splats of step `step`.
  // `read_keys` may look at them before they are sorted; what was left has keys of 0.
  using KeyReader = std::function<void(const KeyedSplats& keyed, const KeyWindow& window)>;
  SortedSplats next(std::size_t step, SortedSplats sorted, std::uint32_t first,
                    const KeyReader& read_keys = {}) const;

 private:
  // A window, or where all of its keys are one the part of it that some chunks have.
  struct Step {
    KeyWindow window;  // whose splats are the most that there may be
    std::size_t first_chunk = 0, end_chunk = 0;
  };
  void add_steps(const KeyWindow& window);

  const StageContext& context_;
  const Projector& projector_;
  const Sorter& sorter_;
  KeyCounter counter_;
  const std::uint64_t capacity_;
  std::vector<Step> steps_;
};

}  // namespace splotchcl
