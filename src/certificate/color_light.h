#pragma once

#include <cstddef>
#include <vector>

#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What errors of colors do to a picture: where a splat errs in one channel by a part of its
// brightest, which may be far brighter than the one that errs (docs/dev/accuracy.md, "Colors and
// intensities").
class ColorLight {
 public:
  // `depths` as of measure_light().
  ColorLight(const Image& image, const std::vector<float>& depths, const Frame& frame,
             const FramePlan& plan);

  // The most that a pixel of this block (BlockErrors) errs over max(1, I), where every splat errs
  // by the whole of itself. `layers`: of an ordered block, how many times what is added is taken
  // away of what lies behind, at most.
  double in_block(std::size_t block, double layers) const;

 private:
  double of_pixel(const float* pixel, double deepest) const;

  const Image& image_;
  const std::vector<float>& depths_;
  LightPlan light_;
  double source_, contrast_;  // proportional
};

}  // namespace splotchcl
