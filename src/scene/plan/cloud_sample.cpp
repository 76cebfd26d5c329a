#include "scene/plan/cloud_sample.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <optional>

#include "scene/constants.h"
#include "scene/particle_rules.h"
#include "scene/peak_color.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

// Of more than `most_in_full` so many.
constexpr std::size_t cloud_sample_limit = 32768, most_in_full = 65536;

bool reaches_picture(const SampledCloud& cloud, const Frame& frame) {
  const double reach = 7 * cloud.sigma;  // no cloud is drawn farther
  return cloud.x >= -reach && cloud.x <= frame.width + reach && cloud.y >= -reach &&
         cloud.y <= frame.height + reach;
}

// Of a component, the sampled clouds that may be seen.
class ComponentSample {
 public:
  ComponentSample(const DrawnComponent& component, const Frame& frame, std::size_t stride)
      : component_(component),
        frame_(frame),
        stride_(stride),
        colors_(component),
        emitted_part_(peak_emission(component) / std::max(peak_color(component), 1e-300)) {
    for (const Column* column : component.particles.columns()) {
      const bool lies_in_memory = column->is_array() && !column->source();
      if (lies_in_memory && component.particles.count > 0)
        arrays_.push_back({column->data(), column->size() / component.particles.count});
    }
  }

  std::size_t count() const {
    const std::size_t particles = component_.particles.count;
    return particles / stride_ + (particles % stride_ != 0);
  }

  // Sampled particles lie pages apart, so that a processor waits for each, unless it is asked to
  // fetch them while it looks at others.
  void ask_for(std::size_t sampled) const {
    if (sampled >= count()) return;
    const std::size_t i = particle(sampled);
    for (const Array& array : arrays_)
      fetch(array.values + array.of_particle * i);
  }

  std::optional<SampledCloud> cloud(std::size_t sampled) const {
    const std::size_t i = particle(sampled);
    const std::optional<PictureCloud> found = cloud_in_picture(component_, frame_, i);
    if (!found) return std::nullopt;
    SampledCloud cloud;
    cloud.x = found->x;
    cloud.y = found->y;
    const DrawnWidth drawn = drawn_width(found->sigma, frame_.kernel, found->of_lens);
    cloud.sigma = drawn.sigma;
    if (!reaches_picture(cloud, frame_)) return std::nullopt;
    const double amplitude = colors_(i) / component_.reference_column * found->column;
    cloud.light = amplitude * drawn.column * std::min(1.0, pi * cloud.sigma * cloud.sigma);
    cloud.emitted_part = emitted_part(amplitude);
    cloud.weight = static_cast<double>(stride_);
    return cloud;
  }

 private:
  struct Array {
    const float* values;
    std::size_t of_particle;  // so many
  };
  std::size_t particle(std::size_t sampled) const {
    return sampled_index(sampled * stride_, stride_, component_.particles.count);
  }
  // With gray absorption the dim emit less than they absorb (scene.h, Absorption).
  double emitted_part(double amplitude) const {
    if (component_.absorption.kind != Absorption::Kind::gray) return emitted_part_;
    return amplitude > 0 ? amplitude / (amplitude + component_.absorption.factor) : 0;
  }
  static void fetch(const float* value) {
#ifdef __GNUC__
    __builtin_prefetch(value);
#endif
  }

  const DrawnComponent& component_;
  const Frame& frame_;
  std::size_t stride_;
  PeakColors colors_;
  double emitted_part_;
  std::vector<Array> arrays_;  // the component's columns that lie in memory
};

// Columns that are made as they are wanted keep a block of what they made last, and ranks that
// share particles ask for them one after the other.
bool are_arrays(const Particles& particles) {
  const auto columns = particles.columns();
  return std::all_of(columns.begin(), columns.end(),
                     [](const Column* column) { return !column->is_array() || !column->source(); });
}

// In the particles' order.
void append(const ComponentSample& component, const BlockLoop& loop,
            std::vector<SampledCloud>& sample) {
  constexpr std::size_t at_once = 512, ahead = 16;
  std::vector<std::vector<SampledCloud>> blocks(component.count() / at_once + 1);
  loop(component.count(), at_once, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      component.ask_for(i + ahead);
      if (const std::optional<SampledCloud> cloud = component.cloud(i))
        blocks[first / at_once].push_back(*cloud);
    }
  });
  for (const std::vector<SampledCloud>& block : blocks)
    sample.insert(sample.end(), block.begin(), block.end());
}

}  // namespace

std::optional<PictureCloud> cloud_in_picture(const DrawnComponent& component, const Frame& frame,
                                             std::size_t i) {
  using namespace boost::qvm;
  const Particles& particles = component.particles;
  const double h = component.size_factor * static_cast<double>(particles.smoothing_length[i]);
  const double sigma = frame.kernel.width * h;
  const Vec3 offset = {{static_cast<double>(particles.position[3 * i]),
                        static_cast<double>(particles.position[3 * i + 1]),
                        static_cast<double>(particles.position[3 * i + 2])}};
  const Vec3 from_camera = particles.origin - frame.camera.position + offset;
  const std::optional<Projected> place =
      project_point(along_axes(from_camera, frame.camera), frame.camera, frame.projection);
  if (!place) return std::nullopt;
  if (!is_within_limits(frame, place->depth, h)) return std::nullopt;

  PictureCloud cloud;
  cloud.x = place->x;
  cloud.y = place->y;
  cloud.depth = place->depth;
  // A cloud that is no circle has the light of a circle of the same area.
  const double height = sigma * place->pixels_per_length;
  cloud.sigma = height * std::sqrt(stretch_of_area(*place, height, frame.camera, frame.projection));
  cloud.of_lens = frame.lens.aperture > 0 ? lens_sigma(frame, place->pixels_per_length) : 0;
  const double weight = particles.weight.is_absent() ? 1 : static_cast<double>(particles.weight[i]);
  cloud.column = central_column(component.weight, weight, h, sigma);
  if (!particles.intensity.is_absent()) {
    cloud.column *= normalized(static_cast<double>(particles.intensity[i]), component.intensity);
  }
  cloud.column *= part_after_fade(frame, cloud.depth);
  const bool is_good = std::isfinite(cloud.x) && std::isfinite(cloud.y) &&
                       std::isfinite(cloud.depth) && cloud.sigma > 0 &&
                       std::isfinite(cloud.sigma) && cloud.column > 0 &&
                       std::isfinite(cloud.column);
  if (!is_good) return std::nullopt;
  return cloud;
}

void one_after_the_other(std::size_t count, std::size_t block_size,
                         const std::function<void(std::size_t, std::size_t)>& work) {
  for (std::size_t first = 0; first < count; first += block_size)
    work(first, std::min(first + block_size, count));
}

std::vector<SampledCloud> sample_clouds(const Frame& frame, const BlockLoop& loop) {
  const std::uint64_t count = particle_count(frame);
  const std::size_t stride = count <= most_in_full ? 1 : sample_stride(count, cloud_sample_limit);
  std::vector<SampledCloud> sample;
  for (const DrawnComponent& component : frame.components) {
    const bool may_share = are_arrays(component.particles);
    append(ComponentSample(component, frame, stride),
           may_share ? loop : BlockLoop(one_after_the_other), sample);
  }
  return sample;
}

}  // namespace splotchcl
