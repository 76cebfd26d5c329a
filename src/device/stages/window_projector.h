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

  // What goes among the splats of a step: `count` more with keys below `end`, which `append` puts
  // behind them. It may look at their keys, those of what was left before being 0.
  struct MoreSplats {
    std::function<std::uint32_t(std::uint64_t end)> count;
    std::function<void(std::uint64_t end, KeyedSplats& keyed)> append;
  };
  // What of `sorted` is left from place `first` on, and behind it the splats of step `step`.
  SortedSplats next(std::size_t step, SortedSplats sorted, std::uint32_t first,
                    const MoreSplats& more) const;

 private:
  // A window, or where all of its keys are one the part of it that some chunks have.
  struct Step {
    KeyWindow window;  // whose splats are the most that there may be
    std::size_t first_chunk = 0, end_chunk = 0;
  };
  // All splats with keys below it are of this step or of those before.
  std::uint64_t end_of_step(std::size_t step) const;
  void add_steps(const KeyWindow& window);

  const StageContext& context_;
  const Projector& projector_;
  const Sorter& sorter_;
  KeyCounter counter_;
  const std::uint64_t capacity_;
  std::vector<Step> steps_;
};

}  // namespace splotchcl
