#pragma once

#include <cstdint>

#include "device/frame/picture_layout.h"
#include "device/frame/variant.h"
#include "device/opencl/device_traits.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The most splats of an ordered frame that have room in `memory` bytes at one time, with their
// keys, beside the picture's planes and the lists of a chunk. No less than a chunk's, whatever room
// there is.
std::uint64_t splat_capacity(const FramePlan& plan, const Variant& variant,
                             const PictureLayout& layout, const DeviceTraits& traits,
                             std::uint64_t memory);

// The slots of an ordered frame's splats, drawn in one piece: each block of particles has room for
// the splats of all of its particles (Projector).
std::uint64_t splat_slots(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);

}  // namespace splotchcl
