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

// Light of one channel in the pixels of a block.
struct Range {
  double least = std::numeric_limits<double>::max(), most = 0;
};

// What a block does for an error of 1 in a sum of splats, and of a part of every splat; and the
// same over max(1, I), pixel by pixel.
struct Response {
  double of_sum = 0, of_parts = 0, relative = 1, layers = 0;
};

// I = q + (background - q) T with T = exp(-x): dI / dx = q - I, and an error of a part of every
// splat is that times x. `contrast`: the most that q and the background differ.
Response of_proportional(const Range& light, double source, double contrast) {
  constexpr double euler = 2.718281828459045;
  const double low = std::abs(source - light.least), high = std::abs(source - light.most);
  const bool passes_source = light.least < source && source < light.most;
  const double least = passes_source ? 0 : std::min(low, high), most = std::max(low, high);
  // -T ln T is largest where T = 1 / e.
  const double at = std::clamp(contrast / euler, least, most);
  const double of_parts = at > 0 ? std::max(0.0, -at * std::log(at / contrast)) : 0;
  // What has faded below 1 counts as an error of the sum.
  return {most, of_parts, std::max({1.0, most, of_parts}) / std::max(1.0, light.least), 0};
}

// A splat in front takes away from what lies behind, of which no more reaches the eye than the
// pixel's whole light, and adds its own: an error of a part e of it does e (E T - A I), of which
// neither is negative. Absorption counts as `expected` of emission (plan.h, light_behind). Errors
// of a part of every splat do no more than to a single source, and no more than where all light
// lies as deep as it may, which over the light falls as that grows; of either sign what all take
// away, and what they add (docs/dev/accuracy.md).
Response of_ordered(double light, double opacity, double brightest_behind, double expected) {
  constexpr double euler = 2.718281828459045, deep = 60;
  const double depth = opacity < 1 ? std::min(-std::log1p(-opacity), deep) : deep;
  const auto of_parts = [&](double of) {
    const double deepest = of > 0 ? std::min(depth - 1, std::log(brightest_behind / of)) : 0.0;
    return std::min(brightest_behind * std::min(opacity, 1 / euler), of * std::max(1.0, deepest));
  };
  const double one_by_one = std::min(1 + depth, 2 + std::log(std::max(1.0, brightest_behind)));
  return {std::max(1.0, light / expected), of_parts(light), std::max(one_by_one, 1 / expected),
          of_parts(std::min(light, 1.0))};
}

struct BlockRanges {
  std::array<Range, 3> channels;
  double opacity = 0;  // the largest
};

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
    ranges.channels[c] = {static_cast<double>(least[c]), static_cast<double>(most[c])};
  ranges.opacity = static_cast<double>(most[3]);
  return ranges;
}

double brightest_channel(const std::vector<BlockRanges>& blocks) {
  double brightest = 0;
  for (const BlockRanges& block : blocks) {
    for (const Range& channel : block.channels)
      brightest = std::max(brightest, channel.most);
  }
  return brightest;
}

// The brightest that shines through a layer. What emits without absorbing has no brightest
// source, but nothing that is seen is brighter than it is seen somewhere.
double brightest_behind(const std::vector<BlockRanges>& blocks, const Frame& frame) {
  return std::min(std::max(brightest_background(frame), brightest_source(frame)),
                  std::max(1.0, brightest_channel(blocks)));
}

// What all blocks of a picture share.
struct Surroundings {
  LightPlan light;
  std::array<double, 3> source;
  double background;
  double behind, expected;  // ordered
};

Response response_of(const BlockRanges& ranges, std::size_t channel, const Surroundings& around) {
  const Range& light = ranges.channels[channel];
  if (around.light == LightPlan::emission) return {1, light.most, 1, 0};
  if (around.light == LightPlan::ordered) {
    return of_ordered(light.most, ranges.opacity, around.behind, around.expected);
  }
  const double source = around.source[channel];
  return of_proportional(light, source, source + around.background);
}

BlockLight light_of(const BlockRanges& ranges, const Surroundings& around) {
  BlockLight block;
  double least = std::numeric_limits<double>::max();
  for (std::size_t c = 0; c < 3; ++c) {
    const Response response = response_of(ranges, c, around);
    block.response = std::max(block.response, response.of_sum);
    block.even = std::max(block.even, response.of_parts);
    block.relative = std::max(block.relative, response.relative);
    block.layers = std::max(block.layers, response.layers);
    least = std::min(least, ranges.channels[c].least);
  }
  block.allowed = std::max(1.0, least);
  return block;
}

}  // namespace

PictureLight measure_light(const Image& image, const Frame& frame, const FramePlan& plan) {
  constexpr int side = BlockErrors::block_pixels;
  PictureLight picture;
  picture.columns = BlockErrors::blocks_along(image.width);
  picture.rows = BlockErrors::blocks_along(image.height);
  const auto columns = static_cast<std::size_t>(picture.columns);
  std::vector<BlockRanges> ranges(columns * static_cast<std::size_t>(picture.rows));
  for_blocks(ranges.size(), columns, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      ranges[b] = ranges_of(image, static_cast<int>(b % columns) * side,
                            static_cast<int>(b / columns) * side);
  });
  const bool is_ordered = plan.light == LightPlan::ordered;
  const Surroundings around = {plan.light, plan.source, brightest_background(frame),
                               is_ordered ? brightest_behind(ranges, frame) : 0, plan.light_behind};
  picture.blocks.resize(ranges.size());
  for_blocks(ranges.size(), columns, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      picture.blocks[b] = light_of(ranges[b], around);
  });
  return picture;
}

}  // namespace splotchcl
