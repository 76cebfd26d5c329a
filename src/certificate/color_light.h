#pragma once

#include <cstddef>
#include <vector>

#include "certificate/color_errors.h"
#include "certificate/octave_errors.h"
#include "certificate/picture_light.h"
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

  bool are_exact() const { return parts_.of_brightest == 0; }
  // Whether bound_in_block() is one.
  bool has_bounds() const { return parts_.are_bounds; }
  // Whether all pixels of a sum err by no more than that, whatever their colors.
  bool are_within(double error) const;
  // The most that a pixel of this block (BlockErrors) errs over max(1, I); what is less than
  // `negligible` may be larger than that. `depth`: of an ordered block, how deep its splats are
  // together as far as that is known.
  double in_block(std::size_t block, const BlockLight& light, double depth,
                  double negligible) const;
  // The most that any splats do that give such a picture.
  double bound_in_block(std::size_t block, const BlockLight& light) const;

 private:
  double at_most(double brightest, double deepest) const;
  double of_pixel(const float* pixel, double deepest) const;
  double of_brightest(const PixelBlock& pixels, double deepest) const;
  double depth_of(std::size_t block) const;
  double bound_of_pixel(const float* pixel, double deepest) const;

  const Image& image_;
  const std::vector<float>& depths_;
  ColorParts parts_;
  LightPlan light_;
  double source_, contrast_;  // proportional
  double tinted_;             // the part of a depth that hides one channel and not another
};

}  // namespace splotchcl
