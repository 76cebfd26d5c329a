#pragma once

#include "device/frame/shared.h"
#include "device/opencl/buffer_pool.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The palettes of a frame's components on the device, and what a plan of this light adds up of
// them.
struct ComponentColorTable {
  Buffer<shared::ComponentColors> components;
  Buffer<float> knots;  // KNOT_FLOATS each
};

ComponentColorTable upload_component_colors(const Frame& frame, LightPlan light, BufferPool& pool);

}  // namespace splotchcl
