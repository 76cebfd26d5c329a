#pragma once

#include <cstdint>

#include "device/frame/picture_layout.h"
#include "device/frame/specialization.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The most splats of an ordered frame that have room in `memory` bytes at one time, with their
// keys, beside the picture's planes and the lists of a chunk. No less than a chunk's, whatever room
// there is.
std::uint64_t splat_capacity(const FramePlan& plan, const Specialization& specialization,
                             const PictureLayout& layout, const DeviceTraits& traits,
                             std::uint64_t memory);

}  // namespace splotchcl
