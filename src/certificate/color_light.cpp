#include "certificate/color_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "parallel/for_blocks.h"
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

constexpr std::size_t rows_at_once = 16;

float brightest_of_row(const Image& image, int y) {
  float most[3] = {0, 0, 0};
  const float* pixel = image.at(0, y);
  for (int x = 0; x < image.width; ++x, pixel += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      most[c] = pixel[c] > most[c] ? pixel[c] : most[c];
  }
  return std::max({most[0], most[1], most[2]});
}

}  // namespace

ColorLight::ColorLight(const Image& image, const std::vector<float>& depths, const Frame& frame,
                       const FramePlan& plan)
    : image_(image),
      depths_(depths),
      parts_(parts_of_colors(frame, plan)),
      light_(plan.light),
      source_(plan.source[0]),
      contrast_(plan.source[0] + brightest_background(frame)) {}

// Of pixels that are no brighter and no deeper than that.
double ColorLight::at_most(double brightest, double deepest) const {
  return light_ == LightPlan::proportional ? std::max(deepest, 0.0) * contrast_ : brightest;
}

bool ColorLight::are_within(double error) const {
  const double deepest =
      depths_.empty() ? 0 : static_cast<double>(*std::max_element(depths_.begin(), depths_.end()));
  std::vector<float> rows(static_cast<std::size_t>(image_.height));
  if (light_ == LightPlan::emission) {
    for_blocks(rows.size(), rows_at_once, [&](std::size_t first, std::size_t last) {
      for (std::size_t y = first; y < last; ++y)
        rows[y] = brightest_of_row(image_, static_cast<int>(y));
    });
  }
  const double brightest =
      rows.empty() ? 0 : static_cast<double>(*std::max_element(rows.begin(), rows.end()));
  return parts_.of_brightest * at_most(brightest, deepest) <= error;
}

double ColorLight::of_pixel(const float* pixel, double deepest) const {
  const auto faintest = static_cast<double>(std::min({pixel[0], pixel[1], pixel[2]}));
  const auto brightest = static_cast<double>(std::max({pixel[0], pixel[1], pixel[2]}));
  if (light_ != LightPlan::proportional) return brightest / std::max(1.0, faintest);
  return brightest > 0 ? of_depth(faintest, brightest, deepest, source_, contrast_) : 0;
}

double ColorLight::of_brightest(const PixelBlock& pixels, double deepest) const {
  double largest = 0;
  for (int y = pixels.y0; y < std::min(pixels.y1, image_.height); ++y) {
    for (int x = pixels.x0; x < std::min(pixels.x1, image_.width); ++x)
      largest = std::max(largest, of_pixel(image_.at(x, y), deepest));
  }
  return largest;
}

// Opaque layers of one channel hide how deep they are, and what others let through of them.
double ColorLight::in_block(std::size_t block, const BlockLight& light, double depth,
                            double negligible) const {
  constexpr double unknown = 88, opaque = 10;
  // Which may be infinite.
  const double of_itself = light.parts > 0 ? parts_.of_itself * light.parts : 0;
  if (of_itself <= negligible) return of_itself;
  const double deepest = depths_.empty() ? unknown : static_cast<double>(depths_[block]);
  const PixelBlock pixels = pixels_of_block(block, BlockErrors::blocks_along(image_.width));
  double most = at_most(light.most, deepest);
  if (parts_.of_brightest * most > negligible) most = of_brightest(pixels, deepest);
  if (light_ == LightPlan::ordered)
    most = most * (1 + light.behind) + (deepest > opaque ? std::max(deepest, depth) : 0);
  return std::min(of_itself, parts_.of_brightest * most);
}

}  // namespace splotchcl
