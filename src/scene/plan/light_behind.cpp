#include "scene/plan/light_behind.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "scene/peak_color.h"
#include "scene/plan/cloud_in_picture.h"
#include "scene/plan/light_structure.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr std::size_t sample_limit = 2048;

// What a particle takes away, all pixels together, and the E / A that it would have if it were
// opaque.
struct SampledSource {
  double source = 0, absorption = 0;
};

void sample_component(const DrawnComponent& component, const Frame& frame, std::size_t stride,
                      std::vector<SampledSource>& sample) {
  const bool is_gray = component.absorption.kind == Absorption::Kind::gray;
  const double brightest = brightest_source(component);
  const double absorption = peak_absorption(component) / component.reference_column;
  for (std::size_t first = 0; first < component.particles.count; first += stride) {
    const std::size_t i = sampled_index(first, stride, component.particles.count);
    const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
    if (!cloud) continue;
    const double amplitude = absorption * cloud->column;
    const double source =
        is_gray ? amplitude / (amplitude + component.absorption.factor) : brightest;
    const double taken = amplitude * cloud->sigma * cloud->sigma;
    if (taken > 0 && std::isfinite(taken)) sample.push_back({source, taken});
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

}  // namespace

double guess_light_behind(const Frame& frame) {
  // Opaque pixels may be of brighter sources than most; nothing is brighter than the brightest.
  constexpr double brighter_than_most = 3;
  // Opacity, which is no light but comes with it, may err by ten times the tolerance; and errors of
  // absorption are to stay below a twentieth, so that what they do is proportional to them.
  constexpr double least = 0.1, most_missing = 0.05;
  const double brightest = brightest_source(frame);
  if (!std::isfinite(brightest)) return 1;
  const std::size_t stride = sample_stride(particle_count(frame), sample_limit);
  std::vector<SampledSource> sample;
  for (const DrawnComponent& component : frame.components)
    sample_component(component, frame, stride, sample);
  const double source = std::min(brightest, brighter_than_most * high_source(sample));
  const double guess = std::max(source, brightest_background(frame));
  return std::min(1.0, std::max({guess, least, frame.tolerance / most_missing}));
}

}  // namespace splotchcl
