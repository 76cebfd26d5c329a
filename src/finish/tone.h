#pragma once

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// What the display shows of exposed light >= 0 of a pixel's brightest channel, where `white` > 0
// becomes 1. Each curve goes from 0 at 0 and never falls; asinh and filmic end at 1.
//   linear  light / white
//   asinh   asinh(10 light) / asinh(10 white): straight where it is dark, a logarithm where it is
//           bright (Lupton et al. 2004, PASP 116, 133)
//   filmic  f(light) / f(white) with John Hable's curve (Filmic Tonemapping Operators, 2010)
//           f(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F
//           A = 0.22, B = 0.30, C = 0.10, D = 0.20, E = 0.01, F = 0.30
double tone(ToneCurve curve, double light, double white);

// The curve for each pixel: red, green and blue times tone(N) / N, N the largest of them. This is a
// curve of luminance that starts, for each hue, at 0 and ends at the brightest that a display can
// show in that hue; Rec. 709's luminance itself would push pure colors that are within the
// display's reach out of it. Alpha stays, and so does light that is not finite.
void apply_tone(Image& image, ToneCurve curve, double white);

}  // namespace splotchcl
