#pragma once

#include <cstddef>
#include <vector>

#include "certificate/octave_errors.h"
#include "certificate/picture_light.h"
#include "splotchcl/frame.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// The part by which a splat may err in any channel since its place in the palette, and its
// intensity, are rounded (docs/dev/accuracy.md, "Colors and intensities"): of its brightest
// channel's light, and of the channel's own; the latter is infinite where a channel has no light at
// a knot. By roundings of either sign as an estimate, all of one sign where a bound is asked for
// (FramePlan::certify) and in extended precision. No part of its light bounds what a splat errs by
// whose palette, or intensity, comes close to black elsewhere than where it begins: what is given
// then is an estimate.
struct ColorParts {
  double of_brightest = 0, of_itself = 0;
  bool are_bounds = true;
};
ColorParts parts_of_colors(const Frame& frame, const FramePlan& plan);

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
  template <class OfPixel>
  double largest_in(std::size_t block, const OfPixel& of_pixel) const;
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
