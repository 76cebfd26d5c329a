#include "certificate/picture_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "parallel/for_blocks.h"
#include "scene/plan/light_structure.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// What emits without absorbing has no brightest source, but a splat is no brighter than 2^60
// (kernels/project/project.h), and there are no more than 2^32.
constexpr double most_light = 0x1p92;

struct Range {
  double least = std::numeric_limits<double>::max(), most = 0;
};

// What a block does for an error of 1 in a sum of splats, and of a part of every splat alike; and
// over max(1, I), pixel by pixel, of a part of every splat that may differ (BlockLight).
struct Response {
  double of_sum = 0, of_parts = 0, parts = 0, layers = 0, behind = 0, relative = 1;
};

Response of_emission(const Range& light) {
  return {1, light.most, std::min(light.most, 1.0), 0, 0, 1};
}

// I = q + (background - q) T with T = exp(-x): dI / dx = q - I, and errors of parts of splats are
// at most that times x. `contrast`: the most that q and the background differ.
Response of_proportional(const Range& light, double source, double contrast) {
  constexpr double euler = 2.718281828459045;
  const double low = std::abs(source - light.least), high = std::abs(source - light.most);
  const bool passes_source = light.least < source && source < light.most;
  const double least = passes_source ? 0 : std::min(low, high), most = std::max(low, high);
  // -T ln T is largest where T = 1 / e.
  const double at = std::clamp(contrast / euler, least, most);
  const double of_parts = at > 0 ? std::max(0.0, -at * std::log(at / contrast)) : 0;
  const double faintest = std::max(1.0, light.least);
  // What has faded below 1 counts as an error of the sum.
  return {most, of_parts, of_parts / faintest, 0, 0, std::max({1.0, most, of_parts}) / faintest};
}

// What lies behind layers in an ordered pixel: how deep the deepest channel is, and the brightest
// source that may be there. Absorption counts as `expected` of emission (plan.h, light_behind).
struct Behind {
  double depth, brightest, expected;
};

// From behind the depth u no more reaches the eye than the pixel's whole light, and no more than
// b exp(-u): what an error of a part of every layer takes away of it, over that part.
double taken_away(double light, const Behind& behind) {
  if (light <= 0) return 0;
  const double fading = std::max(0.0, std::log(behind.brightest / light));
  return std::min(light * std::min(behind.depth, 1 + fading),
                  behind.brightest * -std::expm1(-behind.depth));
}

// By a part of every layer alike an error is no more than of a single source, and no more than
// where all light lies as deep as it may.
double scaled_alike(double light, const Behind& behind) {
  constexpr double euler = 2.718281828459045;
  const double opacity = -std::expm1(-behind.depth);
  const double deepest =
      light > 0 ? std::min(behind.depth - 1, std::log(behind.brightest / light)) : 0.0;
  return std::min(behind.brightest * std::min(opacity, 1 / euler), light * std::max(1.0, deepest));
}

// A splat in front takes away from what lies behind and adds its own: an error of a part e of it
// does e (E T - A I), of which neither is negative and together neither is more than `taken` or
// the light. Over max(1, I) both are largest at I = 1 or below (docs/dev/accuracy.md).
Response of_ordered(double light, const Behind& behind) {
  const double counted = std::min(light, 1.0), taken = taken_away(counted, behind);
  const double taken_of_1 = taken_away(1, behind);
  return {std::max(1.0, light / behind.expected),
          scaled_alike(light, behind),
          counted + taken,
          std::max(counted, taken),
          taken_of_1,
          std::max(1 + taken_of_1, 1 / behind.expected)};
}

using BlockRanges = std::array<Range, 3>;

BlockRanges ranges_of(const Image& image, int x0, int y0) {
  constexpr int side = BlockErrors::block_pixels;
  std::array<float, 4> least, most{};
  least.fill(std::numeric_limits<float>::max());
  for (int y = y0; y < std::min(y0 + side, image.height); ++y) {
    for (int x = x0; x < std::min(x0 + side, image.width); ++x) {
      const float* pixel = image.at(x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        least[c] = pixel[c] < least[c] ? pixel[c] : least[c];
        most[c] = pixel[c] > most[c] ? pixel[c] : most[c];
      }
    }
  }
  BlockRanges ranges;
  for (std::size_t c = 0; c < 3; ++c)
    ranges[c] = {static_cast<double>(least[c]), static_cast<double>(most[c])};
  return ranges;
}

struct Surroundings {
  LightPlan light;
  std::array<double, 3> source;
  double background;
};

Response response_of(const BlockRanges& ranges, std::size_t channel, const Surroundings& around,
                     const Behind& behind) {
  const Range& light = ranges[channel];
  if (around.light == LightPlan::emission) return of_emission(light);
  if (around.light == LightPlan::ordered) return of_ordered(light.most, behind);
  const double source = around.source[channel];
  return of_proportional(light, source, source + around.background);
}

BlockLight light_of(const BlockRanges& ranges, const Surroundings& around, const Behind& behind) {
  BlockLight block;
  double least = std::numeric_limits<double>::max();
  for (std::size_t c = 0; c < 3; ++c) {
    const Response response = response_of(ranges, c, around, behind);
    block.response = std::max(block.response, response.of_sum);
    block.even = std::max(block.even, response.of_parts);
    block.parts = std::max(block.parts, response.parts);
    block.layers = std::max(block.layers, response.layers);
    block.behind = std::max(block.behind, response.behind);
    block.relative = std::max(block.relative, response.relative);
    block.most = std::max(block.most, ranges[c].most);
    least = std::min(least, ranges[c].least);
  }
  block.allowed = std::max(1.0, least);
  return block;
}

}  // namespace

PictureLight measure_light(const Image& image, const std::vector<float>& depths, const Frame& frame,
                           const FramePlan& plan) {
  constexpr int side = BlockErrors::block_pixels;
  constexpr double deepest_of_floats = 88;
  PictureLight picture;
  picture.columns = BlockErrors::blocks_along(image.width);
  picture.rows = BlockErrors::blocks_along(image.height);
  const auto columns = static_cast<std::size_t>(picture.columns);
  const Surroundings around = {plan.light, plan.source, brightest_background(frame)};
  const double source = std::min(brightest_source(frame), most_light);
  const double brightest = std::max({1.0, around.background, source});
  picture.blocks.resize(columns * static_cast<std::size_t>(picture.rows));
  for_blocks(picture.blocks.size(), columns, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const BlockRanges ranges = ranges_of(image, static_cast<int>(b % columns) * side,
                                           static_cast<int>(b / columns) * side);
      const double depth = depths.empty() ? deepest_of_floats : static_cast<double>(depths[b]);
      picture.blocks[b] = light_of(ranges, around, {depth, brightest, plan.light_behind});
    }
  });
  return picture;
}

}  // namespace splotchcl
