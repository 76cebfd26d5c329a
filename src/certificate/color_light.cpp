#include "certificate/color_light.h"

#include <algorithm>
#include <array>
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

// Between two knots as at one of them: both are quotients of linear functions.
double tint_of(const Rgb& absorption) {
  const auto [least, most] = std::minmax({absorption[0], absorption[1], absorption[2]});
  return most > 0 ? 1 - static_cast<double>(least) / static_cast<double>(most) : 0;
}

// By which part of its depth the channel that matter absorbs most is deeper than another one, at
// most.
double tint_of(const Frame& frame) {
  double most = 0;
  for (const DrawnComponent& component : frame.components) {
    if (component.absorption.kind == Absorption::Kind::none) continue;
    if (!component.particles.color_vector.is_absent()) return 1;
    const Palette& palette = component.palette;
    for (const Rgb& color : palette.has_own_absorption() ? palette.absorption : palette.emission)
      most = std::max(most, tint_of(color));
  }
  return most;
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
      contrast_(plan.source[0] + brightest_background(frame)),
      tinted_(tint_of(frame)) {}

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

double ColorLight::depth_of(std::size_t block) const {
  constexpr double unknown = 88;
  return depths_.empty() ? unknown : static_cast<double>(depths_[block]);
}

// The brightest channels of all splats together are no more than all channels of the pixel.
double ColorLight::bound_of_pixel(const float* pixel, double deepest) const {
  std::array<double, 3> channels{};
  std::copy_n(pixel, 3, channels.begin());
  const auto [faintest, brightest] = std::minmax_element(channels.begin(), channels.end());
  const double allowed = std::max(1.0, *faintest);
  if (light_ == LightPlan::proportional)
    return 3 * deepest * std::max(std::abs(source_ - *faintest), std::abs(source_ - *brightest)) /
           allowed;
  const double all = (channels[0] + channels[1] + channels[2]) / allowed;
  if (light_ == LightPlan::emission) return all;
  // Of a layer behind and within a depth of x its most absorbed channel shows no less than
  // exp(-x) / (1 + x), and another one exp(tinted_ x) times as much at most. What a layer errs by
  // in depth changes a pixel by that part of what lies behind, and by half of it of the layer.
  return std::exp(tinted_ * deepest) * (1 + deepest) * all + 1.5 * 3 * deepest;
}

double ColorLight::bound_in_block(std::size_t block, const BlockLight& light) const {
  const double deepest = depth_of(block);
  const PixelBlock pixels = pixels_of_block(block, BlockErrors::blocks_along(image_.width));
  double most = 0;
  for (int y = pixels.y0; y < std::min(pixels.y1, image_.height); ++y) {
    for (int x = pixels.x0; x < std::min(pixels.x1, image_.width); ++x)
      most = std::max(most, bound_of_pixel(image_.at(x, y), deepest));
  }
  // A part that may be infinite.
  const double of_itself = light.parts > 0 ? parts_.of_itself * light.parts : 0;
  return std::min(of_itself, parts_.of_brightest * most);
}

// Opaque layers of one channel hide how deep they are, and what others let through of them.
double ColorLight::in_block(std::size_t block, const BlockLight& light, double depth,
                            double negligible) const {
  constexpr double opaque = 10;
  // Which may be infinite.
  const double of_itself = light.parts > 0 ? parts_.of_itself * light.parts : 0;
  if (of_itself <= negligible) return of_itself;
  const double deepest = depth_of(block);
  const PixelBlock pixels = pixels_of_block(block, BlockErrors::blocks_along(image_.width));
  double most = at_most(light.most, deepest);
  if (parts_.of_brightest * most > negligible) most = of_brightest(pixels, deepest);
  if (light_ == LightPlan::ordered)
    most = most * (1 + light.behind) + (deepest > opaque ? std::max(deepest, depth) : 0);
  return std::min(of_itself, parts_.of_brightest * most);
}

}  // namespace splotchcl
