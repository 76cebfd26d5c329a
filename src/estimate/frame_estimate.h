#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// Of all columns that are arrays.
std::uint64_t particle_bytes(const Frame& frame);

// What drawing a frame will take, found from its plan and a sample of its particles.
struct FrameEstimate {
  std::string device;
  int compute_units = 0;
  // The largest total of the buffers that drawing takes at one time: what RenderStats::device_bytes
  // will be, but for some kilobytes and the parts of lists that are cut.
  std::uint64_t device_bytes = 0;
  std::uint64_t particle_bytes = 0;  // the particles' columns, mapped from the file or in memory
  double splats = 0, tile_entries = 0;
  std::uint64_t memory_limit = 0;  // of the device, bytes
  std::uint64_t windows = 0;       // of an ordered frame that has not room in it; 0: in one piece
  // Without compiling kernels. None on a GPU, on which no rates were measured.
  std::optional<double> seconds;
};

// On the device of which `device` is a part of the name, as in RendererOptions; opens it, but
// builds and draws nothing. Throws DeviceError and UsageError as a Renderer does.
// `memory_bytes` as there.
FrameEstimate estimate_frame(const Frame& frame, const FramePlan& plan, const std::string& device,
                             std::uint64_t memory_bytes = 0);

// Lines for --explain. `drawings` are how often such a frame is drawn: views of a picture, frames
// of a film.
std::string explain(const FrameEstimate& estimate, int drawings);

}  // namespace splotchcl
