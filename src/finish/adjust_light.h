#pragma once

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Exposure, then tone, saturation and contrast, of linear light; alpha stays. Nothing happens to
// pixels for settings that change nothing. Exposure and white are known (finish/tone_levels.h).
//   exposure     L' = L 2^exposure
//   tone         as finish/tone.h has it
//   saturation   L' = max(0, Y + saturation (L - Y)), Y = 0.2126 R + 0.7152 G + 0.0722 B
//   contrast     L' = p (L / p)^contrast with p = contrast_pivot^gamma, which is
//                v' = pivot (v / pivot)^contrast of display values v = L^(1/gamma)
void adjust_light(Image& image, const FinishSettings& finish, double gamma);

// The light whose display value v is given: v^gamma.
std::array<float, 3> light_of(const DisplayColor& color, double gamma);

}  // namespace splotchcl
