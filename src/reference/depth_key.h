#pragma once

#include <cstdint>

#include "scene/depth_key.h"

namespace splotchcl::reference {

// Where a particle lies in depth, as scene/depth_key.h says.
struct Depth {
  std::uint64_t key = 0;         // of 48 bits
  bool is_before_camera = true;  // where a projection can show it at all
};

// `position`: three coordinates as they are stored, relative to the component's origin.
Depth depth_of(const float* position, const DepthKeyScale& scale);

// `h` is the smoothing length as it is stored.
bool is_within_limits(const Depth& depth, float h, const DepthKeyScale& scale);

}  // namespace splotchcl::reference
