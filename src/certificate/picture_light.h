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
  double even = 0;      // by how much a pixel errs where every splat errs by the whole of itself
  double relative = 1;  // and over max(1, I) of that pixel, where they err by either sign;
  double layers = 0;    // or, ordered, all by one
};

// A picture in square blocks of pixels, row by row.
struct PictureLight {
  int columns = 0, rows = 0;
  std::vector<BlockLight> blocks;
};

PictureLight measure_light(const Image& image, const Frame& frame, const FramePlan& plan);

}  // namespace splotchcl
