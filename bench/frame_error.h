#pragma once

#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"

// How far frames that have been timed are from the reference renderer's.
namespace splotchcl::bench {

// How far a picture lies from the reference's, in the measure that the tolerance bounds:
// |frame - reference| / max(1, |reference|), over pixels and colours.
struct FrameError {
  double maximum = 0;
  double brightest = 0;  // of the reference's picture: a black picture proves nothing
  double squares = 0;    // summed over `values`
  double values = 0;

  double rms() const;
  void join(const FrameError& other);
};

// `image` shows frame.crop; `reference` any part of it, at `part`.
FrameError measure_error(const Image& image, const Rectangle& image_crop,
                         const ReferenceImage& reference, const Rectangle& part);

// The reference renderer's pictures of small parts of a large frame: only particles that can reach
// a part are drawn there, and all are projected no more than once.
std::vector<ReferenceImage> draw_reference_parts(const Frame& frame,
                                                 const std::vector<Rectangle>& parts);

// Squares that see the middle, a corner and what lies between.
std::vector<Rectangle> sample_parts(const Rectangle& crop, int side);

}  // namespace splotchcl::bench
