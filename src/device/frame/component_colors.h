#pragma once

#include "device/frame/shared.h"
#include "device/opencl/buffer_pool.h"
#include "splotchcl/frame.h"

namespace splotchcl {

// The palettes of a frame's components on the device.
struct ComponentColorTable {
  Buffer<shared::ComponentColors> components;
  Buffer<float> knots;  // KNOT_FLOATS each
};

ComponentColorTable upload_component_colors(const Frame& frame, BufferPool& pool);

}  // namespace splotchcl
