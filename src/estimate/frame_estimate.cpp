#include "estimate/frame_estimate.h"

#include <algorithm>
#include <cmath>

#include "device/frame/splat_capacity.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "estimate/device_memory.h"
#include "estimate/drawing_time.h"
#include "estimate/splat_work.h"
#include "scene/particle_columns.h"

namespace splotchcl {

namespace {

bool has_streamed_columns(const Frame& frame) {
  return std::any_of(
      frame.components.begin(), frame.components.end(),
      [](const DrawnComponent& component) { return has_streamed_column(component.particles); });
}

// As SplatSlices::find decides, of which particles are drawn being an estimate.
void choose_windows(const Frame& frame, const FramePlan& plan, const Variant& variant,
                    const DeviceTraits& traits, FrameEstimate& estimate) {
  const std::uint64_t capacity = splat_capacity(
      plan, variant, make_picture_layout(frame, plan, variant), traits, estimate.memory_limit);
  const bool fit = splat_slots(frame, plan, traits) <= capacity;
  if (!plan.needs_sort() || (fit && !has_streamed_columns(frame))) return;
  estimate.windows = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(estimate.splats / static_cast<double>(capacity))));
  const double in_window = std::min(estimate.splats, static_cast<double>(capacity));
  estimate.device_bytes = estimate_device_bytes_of_windows(frame, plan, variant, traits, in_window);
}

}  // namespace

FrameEstimate estimate_frame(const Frame& frame, const FramePlan& plan, const std::string& device,
                             std::uint64_t memory_bytes) {
  const auto lock = lock_runtime();
  const compute::device chosen = choose_device(device);
  const DeviceTraits traits = traits_of(chosen);
  const Variant variant(frame, plan, traits);
  const SplatWork work = estimate_splat_work(frame, plan, variant);
  FrameEstimate estimate;
  estimate.device = chosen.name();
  estimate.compute_units = static_cast<int>(chosen.compute_units());
  estimate.device_bytes = estimate_device_bytes(frame, plan, variant, traits, work.splats);
  estimate.particle_bytes = particle_bytes(frame);
  estimate.splats = work.splats;
  estimate.tile_entries = work.tile_entries;
  estimate.memory_limit = memory_bytes > 0 ? memory_bytes : memory_of(chosen, traits).total;
  choose_windows(frame, plan, variant, traits, estimate);
  if (!traits.is_gpu) {
    estimate.seconds = estimate_seconds(frame, plan, work, estimate.compute_units);
  }
  return estimate;
}

}  // namespace splotchcl
