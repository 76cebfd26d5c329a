#pragma once

#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

// What a plan expects of a frame before it is drawn, from a sample of its clouds.
namespace splotchcl {

// How many splats the whole picture has that could be stencils, from some of its particles; the
// same for every crop. `narrowest`: of stencils, in pixels.
WideSplats guess_wide_splats(const Frame& frame, double narrowest);

// How bright a frame in which nothing absorbs is likely to be where it is brightest, over a
// twentieth or so of its width, in units of white. A guess from some particles and the brightest
// colors of their palettes, the same for every crop.
double guess_brightness(const Frame& frame);

// What an ordered frame is likely to be like, from some of its particles.
struct OrderedGuess {
  // How bright what lies behind a layer reaches the eye, in units of white: at most 1, and no less
  // than leaves errors of absorption small (plan.h). From the sources E / A and the background, the
  // same for every crop.
  double light_behind = 1;
  // How many of the splats that could lie on coarse grids are drawn over a pixel of the whole
  // picture, on average. The same for every crop.
  double wide_layers = 0;
  double visible_part = 0;
};

OrderedGuess guess_order(const Frame& frame);

}  // namespace splotchcl
