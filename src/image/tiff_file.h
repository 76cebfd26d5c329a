#pragma once

#include <vector>

namespace splotchcl {

// What the numbers of a file stand for, with Rec. 709's primaries and the white of D65: display
// values as IEC 61966-2-1 has them, or linear light.
enum class ColorSpace { srgb, linear };

// An ICC profile, version 4.2 (ICC.1:2004-10), the same bytes at any time.
std::vector<unsigned char> color_profile(ColorSpace space);

}  // namespace splotchcl
