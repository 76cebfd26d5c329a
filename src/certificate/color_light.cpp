#include "certificate/color_light.h"

#include <algorithm>
#include <cmath>

#include "certificate/octave_errors.h"
#include "scene/plan/light_structure.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// What a part of the deepest channel's depth does to the faintest: dI / dx = q - I. Light that has
// come close to its source tells no more of how deep it is.
double of_depth(double faintest, double brightest, double deepest, double source, double contrast) {
  const double least = std::min(std::abs(source - faintest), std::abs(source - brightest));
  const double most = std::max(std::abs(source - faintest), std::abs(source - brightest));
  constexpr double close = 1e-4;
  const double depth =
      least > close * contrast ? std::min(std::log(contrast / least), deepest) : deepest;
  return std::max(depth, 0.0) * most / std::max(1.0, faintest);
}

}  // namespace

ColorLight::ColorLight(const Image& image, const std::vector<float>& depths, const Frame& frame,
                       const FramePlan& plan)
    : image_(image),
      depths_(depths),
      light_(plan.light),
      source_(plan.source[0]),
      contrast_(plan.source[0] + brightest_background(frame)) {}

double ColorLight::of_pixel(const float* pixel, double deepest) const {
  const auto faintest = static_cast<double>(std::min({pixel[0], pixel[1], pixel[2]}));
  const auto brightest = static_cast<double>(std::max({pixel[0], pixel[1], pixel[2]}));
  if (light_ != LightPlan::proportional) return brightest / std::max(1.0, faintest);
  return brightest > 0 ? of_depth(faintest, brightest, deepest, source_, contrast_) : 0;
}

double ColorLight::in_block(std::size_t block, double layers) const {
  const PixelBlock pixels = pixels_of_block(block, BlockErrors::blocks_along(image_.width));
  constexpr double unknown = 88;
  const double deepest = depths_.empty() ? unknown : static_cast<double>(depths_[block]);
  double largest = 0;
  for (int y = pixels.y0; y < std::min(pixels.y1, image_.height); ++y) {
    for (int x = pixels.x0; x < std::min(pixels.x1, image_.width); ++x)
      largest = std::max(largest, of_pixel(image_.at(x, y), deepest));
  }
  return light_ == LightPlan::ordered ? largest * (1 + layers) : largest;
}

}  // namespace splotchcl
