#include "estimate/frame_estimate.h"

#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "estimate/device_memory.h"
#include "estimate/drawing_time.h"
#include "estimate/splat_work.h"

namespace splotchcl {

FrameEstimate estimate_frame(const Frame& frame, const FramePlan& plan, const std::string& device) {
  const auto lock = lock_runtime();
  const compute::device chosen = choose_device(device);
  const DeviceTraits traits = traits_of(chosen);
  const Specialization specialization(frame, plan, traits);
  const SplatWork work = estimate_splat_work(frame, plan, specialization);
  FrameEstimate estimate;
  estimate.device = chosen.name();
  estimate.compute_units = static_cast<int>(chosen.compute_units());
  estimate.device_bytes = estimate_device_bytes(frame, plan, specialization, traits, work.splats);
  estimate.particle_bytes = particle_bytes(frame);
  estimate.splats = work.splats;
  estimate.tile_entries = work.tile_entries;
  if (!traits.is_gpu) {
    estimate.seconds = estimate_seconds(frame, plan, work, estimate.compute_units);
  }
  return estimate;
}

}  // namespace splotchcl
