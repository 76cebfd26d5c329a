#pragma once

#include <cstdint>

#include "device/frame/variant.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The largest total of the buffers that drawing the frame takes at one time, of which `splats`
// reach the picture: what RenderStats::device_bytes will be, but for buffers of some kilobytes and
// the parts of lists that are cut. Particles that are uploaded are counted.
std::uint64_t estimate_device_bytes(const Frame& frame, const FramePlan& plan,
                                    const Variant& variant, const DeviceTraits& traits,
                                    double splats);

// The same of an ordered frame that is drawn in windows of so many splats (docs/large.md).
std::uint64_t estimate_device_bytes_of_windows(const Frame& frame, const FramePlan& plan,
                                               const Variant& variant, const DeviceTraits& traits,
                                               double splats);

// Of all columns that are arrays.
std::uint64_t particle_bytes(const Frame& frame);

}  // namespace splotchcl
