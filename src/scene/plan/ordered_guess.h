#pragma once

#include "splotchcl/frame.h"

namespace splotchcl {

// What an ordered frame is likely to be like, from some of its particles.
struct OrderedGuess {
  // How bright what lies behind a layer reaches the eye, in units of white: at most 1, and no less
  // than leaves errors of absorption small (plan.h). From the sources E / A and the background, the
  // same for every crop.
  double light_behind = 1;
  // How many of the splats that could lie on coarse grids are drawn over a pixel of the whole
  // picture, on average. The same for every crop.
  double wide_layers = 0;
  // Which part of all particles the crop shows.
  double visible_part = 0;
};

OrderedGuess guess_order(const Frame& frame);

}  // namespace splotchcl
