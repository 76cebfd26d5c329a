#include "scene/plan/cloud_sample.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstdlib>
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
      : component_(component), frame_(frame), stride_(stride), colors_(component) {
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
  static void fetch(const float* value) {
#ifdef __GNUC__
    __builtin_prefetch(value);
#endif
  }

  const DrawnComponent& component_;
  const Frame& frame_;
  std::size_t stride_;
  PeakColors colors_;
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

// Of a cell, and what is drawn around it, in pixels.
constexpr int side = 16, around = 32;

// Of clouds beside the picture, the cell at its edge.
int nearest_cell(double place, int count) {
  return static_cast<int>(std::clamp(std::floor(place / side), 0.0, count - 1.0));
}

bool is_beside(const SampledCloud& cloud, const Frame& frame) {
  return cloud.x < 0 || cloud.x >= frame.width || cloud.y < 0 || cloud.y >= frame.height;
}

// Of errors of a sum of so much light, what they do to what is promised: nothing absorbed shows as
// a part of itself, and what is deep hides what is added. Palettes' brightest colors say three or
// four times as much as there is.
double shown_part(LightPlan plan, double light) {
  constexpr double overstated = 4;
  if (plan == LightPlan::emission) return 1 / std::max(1.0, light);
  return plan == LightPlan::proportional ? std::exp(-light / overstated) : 1;
}

bool are_near(const Rectangle& a, const Rectangle& b) {
  return std::abs(a.x - b.x) < around && std::abs(a.y - b.y) < around;
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

LightMap::LightMap(const std::vector<SampledCloud>& clouds, const Frame& frame)
    : width_(frame.width),
      height_(frame.height),
      columns_((frame.width - 1) / side + 1),
      rows_((frame.height - 1) / side + 1),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  constexpr double widest_narrow = 8;            // pixels
  constexpr double brightest = 8;                // brighter ones are drawn by means of their own
  constexpr std::size_t fewest_of_a_sample = 4;  // of fewer a cell tells nothing
  for (const SampledCloud& cloud : clouds) {
    const int x = nearest_cell(cloud.x, columns_), y = nearest_cell(cloud.y, rows_);
    const double area = std::max(1.0, pi * cloud.sigma * cloud.sigma);
    const double of_cell = cloud.weight * std::min(1.0, area / (side * side));
    Cell& cell = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(x)];
    ++cell.clouds;
    if (is_beside(cloud, frame)) {
      cell.beside += of_cell * cloud.light;
      continue;
    }
    cell.light += of_cell * cloud.light;
    if (cloud.sigma < widest_narrow) cell.narrow += of_cell * std::min(cloud.light, brightest);
  }
  const bool is_sample = !clouds.empty() && clouds.front().weight > 1;
  for (Cell& cell : cells_) {
    if (is_sample && cell.clouds < fewest_of_a_sample) cell = {};
  }
}

double LightMap::brightest() const {
  double most = 0;
  for (const Cell& cell : cells_)
    most = std::max(most, cell.light);
  return most;
}

double LightMap::of_bright_quarter() const {
  std::vector<double> lights;
  for (const Cell& cell : cells_)
    lights.push_back(cell.light);
  const auto quarter = lights.end() - 1 - static_cast<std::ptrdiff_t>(lights.size() / 4);
  std::nth_element(lights.begin(), quarter, lights.end());
  return *quarter;
}

bool LightMap::is_at_edge(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_, y = number / columns_;
  return x == 0 || y == 0 || x == columns_ - 1 || y == rows_ - 1;
}

Rectangle LightMap::part_around(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_ * side, y = number / columns_ * side;
  const int left = std::max(x - around, 0), top = std::max(y - around, 0);
  return {left, top, std::min(x + side + around, width_) - left,
          std::min(y + side + around, height_) - top};
}

LightMap::Cell LightMap::most_around(const Cell& cell) const {
  const auto number = static_cast<int>(&cell - cells_.data());
  const int x = number % columns_, y = number / columns_;
  Cell most;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, rows_ - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, columns_ - 1); ++column) {
      const Cell& other = cells_[static_cast<std::size_t>(row * columns_ + column)];
      most.light = std::max(most.light, other.light);
      most.narrow = std::max(most.narrow, other.narrow);
    }
  }
  return most;
}

std::vector<Rectangle> LightMap::telling_parts(LightPlan light) const {
  std::vector<Rectangle> parts;
  const auto add_largest = [&](const auto& value) {
    const Cell* largest = nullptr;
    double most = 0;
    for (const Cell& cell : cells_) {
      const Cell near = light == LightPlan::ordered ? cell : most_around(cell);
      const double found = value(cell, near) * shown_part(light, cell.light);
      if (found > most) largest = &cell;
      most = std::max(most, found);
    }
    if (largest == nullptr) return;
    const Rectangle part = part_around(*largest);
    if (std::none_of(parts.begin(), parts.end(),
                     [&](const Rectangle& other) { return are_near(part, other); }))
      parts.push_back(part);
  };
  add_largest([](const Cell&, const Cell& near) { return near.light; });
  add_largest(
      [](const Cell& cell, const Cell& near) { return near.narrow / std::max(1.0, cell.light); });
  add_largest([&](const Cell& cell, const Cell& near) {
    return is_at_edge(cell) ? near.light + cell.beside : 0;
  });
  add_largest([&](const Cell& cell, const Cell& near) {
    return is_at_edge(cell) ? near.narrow / std::max(1.0, cell.light) : 0;
  });
  return parts;
}

}  // namespace splotchcl
