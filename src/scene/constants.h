#pragma once

#include <cstdint>

namespace splotchcl {

constexpr double pi = 3.14159265358979323846;

constexpr double kpc_in_cm = 3.0856775814913673e21;     // IAU 2015 B2
constexpr double proton_mass_in_g = 1.67262192369e-24;  // CODATA 2018

// Of a picture, in pixels. Kernels count pixels in 32 bits, those of planes and guard bands among
// them; of floats, four to a pixel, the most take 4 GiB.
constexpr int largest_side = 65536;
constexpr std::int64_t largest_pixel_count = std::int64_t{1} << 28;

}  // namespace splotchcl
