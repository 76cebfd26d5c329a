#include "scene/plan/ordered_guess.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/peak_color.h"
#include "scene/plan/cloud_in_picture.h"
#include "scene/plan/light_structure.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr std::size_t order_sample_limit = 2048;

// What a particle takes away, all pixels together, and the E / A that it would have if it were
// opaque.
struct SampledSource {
  double source = 0, absorption = 0;
};

// Splats are drawn so many sigma to each side, or a little less.
constexpr double layer_extent = 2.5;

// The length of what a splat has in common with pixels [first, end) along an axis.
double overlap(double center, double sigma, int first, int end) {
  const double reach = layer_extent * sigma;
  return std::max(0.0,
                  std::min<double>(center + reach, end) - std::max<double>(center - reach, first));
}

// Of how many of a picture's pixels a cloud's splat is drawn, where it is wide enough for a coarse
// grid.
double wide_pixels(const PictureCloud& cloud, const Frame& frame) {
  constexpr double narrowest = 5;
  if (cloud.sigma < narrowest) return 0;
  return overlap(cloud.x, cloud.sigma, 0, frame.width) *
         overlap(cloud.y, cloud.sigma, 0, frame.height);
}

bool is_in_crop(const PictureCloud& cloud, const Rectangle& crop) {
  return overlap(cloud.x, cloud.sigma, crop.x, crop.x + crop.width) > 0 &&
         overlap(cloud.y, cloud.sigma, crop.y, crop.y + crop.height) > 0;
}

struct Sample {
  std::vector<SampledSource> sources;
  double wide_pixels = 0;
  std::size_t particles = 0, visible = 0;
};

void sample_component(const DrawnComponent& component, const Frame& frame, std::size_t stride,
                      Sample& sample) {
  const bool is_gray = component.absorption.kind == Absorption::Kind::gray;
  const double brightest = brightest_source(component);
  const double absorption = peak_absorption(component) / component.reference_column;
  for (std::size_t first = 0; first < component.particles.count; first += stride) {
    const std::size_t i = sampled_index(first, stride, component.particles.count);
    const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
    ++sample.particles;
    if (!cloud) continue;
    if (is_in_crop(*cloud, frame.crop)) ++sample.visible;
    sample.wide_pixels += wide_pixels(*cloud, frame);
    const double amplitude = absorption * cloud->column;
    const double source =
        is_gray ? amplitude / (amplitude + component.absorption.factor) : brightest;
    const double taken = amplitude * cloud->sigma * cloud->sigma;
    if (taken > 0 && std::isfinite(taken)) sample.sources.push_back({source, taken});
  }
}

// The source that 95 % of all absorption does not exceed.
double high_source(std::vector<SampledSource>& sample) {
  std::sort(sample.begin(), sample.end(),
            [](const SampledSource& a, const SampledSource& b) { return a.source < b.source; });
  double all = 0, below = 0;
  for (const SampledSource& one : sample)
    all += one.absorption;
  for (const SampledSource& one : sample) {
    below += one.absorption;
    if (below >= 0.95 * all) return one.source;
  }
  return 1;
}

double light_behind_of(std::vector<SampledSource>& sources, const Frame& frame) {
  // Opaque pixels may be of brighter sources than most; nothing is brighter than the brightest.
  constexpr double brighter_than_most = 3;
  // Opacity, which is no light but comes with it, may err by ten times the tolerance; and errors of
  // absorption are to stay below a twentieth, so that what they do is proportional to them.
  constexpr double least = 0.1, most_missing = 0.05;
  const double source =
      std::min(brightest_source(frame), brighter_than_most * high_source(sources));
  const double guess = std::max(source, brightest_background(frame));
  return std::min(1.0, std::max({guess, least, frame.tolerance / most_missing}));
}

}  // namespace

OrderedGuess guess_order(const Frame& frame) {
  if (!std::isfinite(brightest_source(frame))) return {};
  const std::size_t stride = sample_stride(particle_count(frame), order_sample_limit);
  Sample sample;
  for (const DrawnComponent& component : frame.components)
    sample_component(component, frame, stride, sample);
  OrderedGuess guess;
  guess.light_behind = light_behind_of(sample.sources, frame);
  guess.wide_layers = static_cast<double>(stride) * sample.wide_pixels /
                      (static_cast<double>(frame.width) * frame.height);
  if (sample.particles > 0)
    guess.visible_part =
        static_cast<double>(sample.visible) / static_cast<double>(sample.particles);
  return guess;
}

}  // namespace splotchcl
