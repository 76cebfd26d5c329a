#pragma once

#include <cstdint>

#include "device/frame/picture_layout.h"
#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/buffer_pool.h"
#include "device/opencl/device_context.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The palettes of a frame's components on the device, and what a plan of this light adds up of
// them.
struct ComponentColorTable {
  Buffer<shared::ComponentColors> components;
  Buffer<float> knots;  // KNOT_FLOATS each
};

// What all stages of one frame read, and none changes. The frame, the plan and the device
// outlive it.
struct StageContext {
  StageContext(DeviceContext& on, const Frame& of, const FramePlan& with);

  DeviceContext& device;
  const Frame& frame;
  const FramePlan& plan;
  const Variant variant;
  const PictureLayout layout;
  const Buffer<shared::Grid> grids;
  const Buffer<shared::Stencil> stencils;
  const ComponentColorTable colors;
};

// Sets `bytes` from `first` on to 0, both multiples of 4, as a part of that stage.
void clear_memory(DeviceContext& device, const char* stage, const compute::buffer& memory,
                  std::uint64_t first, std::uint64_t bytes);

}  // namespace splotchcl
