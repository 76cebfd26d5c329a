#pragma once

#include <cstdint>

namespace splotchcl {

// Of a picture, in pixels. Kernels count pixels in 32 bits, those of planes and guard bands among
// them; of floats, four to a pixel, the most take 4 GiB.
constexpr int largest_side = 65536;
constexpr std::int64_t largest_pixel_count = std::int64_t{1} << 28;

}  // namespace splotchcl
