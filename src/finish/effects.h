#pragma once

#include <optional>

#include "splotchcl/finish.h"
#include "splotchcl/image.h"
#include "splotchcl/stereo.h"
#include "splotchcl/views.h"

namespace splotchcl {

// Scatters a part, 0 to 1, of a picture's light around where it falls, as a lens does:
//   L' = (1 - part) L + part (B1 * L + B2 * L + B3 * L) / 3
// with bells B of standard deviations of 1/360, 1/90 and 2/45 of the picture's shorter side. Light
// that would leave the picture is mirrored back, so that all of it stays; alpha stays as it is.
void add_bloom(Image& image, double part);

// What add_bloom does with one bell of so many pixels: along each axis four boxes whose outermost
// samples count in part, which have its variance (P. Gwosdek et al. 2011, LNCS 6667, 447).
Image blurred(const Image& image, double deviation);

// Both mix linear light and alpha, (1 - amount) of the picture and amount of the other.
void mix(Image& image, const Image& other, double amount);  // of the same size
void fade_to_color(Image& image, const FinishSettings& finish, double gamma);

// Throws UsageError where the scene's finish.cross_fade cannot be drawn.
void check_cross_fade(const Scene& scene);

// The other scene of a cross-fade as it is drawn here: in this scene's size and gamma, with its
// camera where it has none, and at its moment where it has the same sequence. Nothing without a
// cross-fade.
std::optional<Scene> cross_fade_scene(const Scene& scene);

// Each pixel the mean of so many columns and rows, which divide the picture, of light and alpha.
Image squeezed(const Image& image, int columns, int rows);

// Both eyes' pictures, of the same size, in one for glasses of red (left) and cyan (right), as
// splotchcl/stereo.h has it. The matrices are about what a display emits: light is taken as the
// display shows it, the display value v = L^(1/gamma) to the power 2.2 and from 0 to 1, and what
// comes out of them is held to 0 and 1, too. Alpha is the mean of both.
Image anaglyph(const Image& left, const Image& right, StereoLayout layout, double gamma);

}  // namespace splotchcl
