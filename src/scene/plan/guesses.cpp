#include "scene/plan/guesses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/constants.h"
#include "scene/peak_color.h"
#include "scene/plan/cloud_sample.h"
#include "scene/plan/light_structure.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

// Each is a page of a mapped file that the system has to find.
constexpr std::size_t width_sample_limit = 512;

// Splats end about so many sigma beside their centers.
constexpr double extent = 3;

bool is_in_picture(const PictureCloud& cloud, const Frame& frame) {
  const double reach = extent * cloud.sigma;
  return cloud.x + reach > 0 && cloud.x - reach < frame.width && cloud.y + reach > 0 &&
         cloud.y - reach < frame.height;
}

}  // namespace

WideSplats guess_wide_splats(const Frame& frame, double narrowest) {
  WideSplats found;
  const std::size_t stride = sample_stride(particle_count(frame), width_sample_limit);
  const double per_pixel =
      static_cast<double>(stride) / (static_cast<double>(frame.width) * frame.height);
  for (const DrawnComponent& component : frame.components) {
    for (std::size_t first = 0; first < component.particles.count; first += stride) {
      const std::size_t i = sampled_index(first, stride, component.particles.count);
      const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i);
      if (!cloud || cloud->sigma < narrowest || !is_in_picture(*cloud, frame)) continue;
      (cloud->sigma < 2 * narrowest ? found.of_one_octave : found.wider) += per_pixel;
    }
  }
  return found;
}

namespace {

constexpr std::size_t brightness_sample_limit = 4096;
constexpr int cells_along = 24;

// The light of sampled clouds, as if it were spread over the cell of their centers, or over
// themselves where they are wider.
class LightOfCells {
 public:
  explicit LightOfCells(const Frame& frame)
      : side_(static_cast<double>(std::max({frame.width, frame.height, 1})) / cells_along),
        columns_(std::max(1, static_cast<int>(std::ceil(frame.width / side_)))),
        rows_(std::max(1, static_cast<int>(std::ceil(frame.height / side_)))),
        light_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(const PictureCloud& cloud, double light_of_column) {
    const int x = cell(cloud.x, columns_), y = cell(cloud.y, rows_);
    if (x < 0 || y < 0) return;
    const double area = pi * cloud.sigma * cloud.sigma;
    light_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x)] +=
        light_of_column * cloud.column * area / std::max(area, side_ * side_);
  }

  double brightest() const { return *std::max_element(light_.begin(), light_.end()); }

 private:
  // Below 0: beside the picture.
  int cell(double place, int count) const {
    const double index = std::floor(place / side_);
    return index >= 0 && index < count ? static_cast<int>(index) : -1;
  }

  double side_;
  int columns_, rows_;
  std::vector<double> light_;
};

}  // namespace

double guess_brightness(const Frame& frame) {
  LightOfCells cells(frame);
  const std::size_t stride = sample_stride(particle_count(frame), brightness_sample_limit);
  for (const DrawnComponent& component : frame.components) {
    const double light =
        static_cast<double>(stride) * peak_emission(component) / component.reference_column;
    for (std::size_t first = 0; first < component.particles.count; first += stride) {
      const std::size_t i = sampled_index(first, stride, component.particles.count);
      if (const std::optional<PictureCloud> cloud = cloud_in_picture(component, frame, i))
        cells.add(*cloud, light);
    }
  }
  const double brightest = cells.brightest();
  return std::isfinite(brightest) ? brightest : 0;
}

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
