#pragma once

#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What errors of splats do in one block of pixels of a drawn picture.
struct BlockLight {
  double response = 0;  // the most by which a pixel errs for an error of 1 in a sum of splats
  double allowed = 1;   // the least of max(1, I) in any pixel and channel
  double most = 0;      // the most of I
  double even = 0;      // by how much a pixel errs where every splat errs by the whole of itself;
  // and over max(1, I) of that pixel, where each errs by up to the whole of itself: of either sign,
  double parts = 0;
  double layers = 0;    // ordered, of one sign,
  double behind = 0;    // of what lies behind, where that is 1 together with them,
  double relative = 1;  // or, of either sign, by itself where it has not faded below 1.
};

// A picture in square blocks of pixels, row by row.
struct PictureLight {
  int columns = 0, rows = 0;
  std::vector<BlockLight> blocks;
};

// `depths`: of the deepest channel of each block; where there are none, any.
PictureLight measure_light(const Image& image, const std::vector<float>& depths, const Frame& frame,
                           const FramePlan& plan);

}  // namespace splotchcl
