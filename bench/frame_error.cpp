#include "frame_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "splotchcl/reference.h"

namespace splotchcl::bench {
namespace {

// At a time, so that the reference's splats of a large snapshot fit in memory.
constexpr std::size_t most_particles = 1000000;

Column slice(const Column& column, std::size_t first, std::size_t count, std::size_t width) {
  if (!column.is_array()) return column;
  return Column(nullptr, column.data() + width * first, width * count);
}

Particles slice(const Particles& all, std::size_t first, std::size_t count) {
  Particles part = all;
  part.count = count;
  part.position = slice(all.position, first, count, 3);
  for (Column Particles::*column :
       {&Particles::smoothing_length, &Particles::weight, &Particles::color, &Particles::intensity,
        &Particles::sort_field}) {
    part.*column = slice(all.*column, first, count, 1);
  }
  return part;
}

Column gather(const Column& column, const std::vector<std::size_t>& chosen, std::size_t width) {
  if (!column.is_array()) return column;
  std::vector<float> values;
  values.reserve(width * chosen.size());
  for (const std::size_t i : chosen) {
    for (std::size_t k = 0; k < width; ++k)
      values.push_back(column[width * i + k]);
  }
  return Column::owning(std::move(values));
}

Particles gather(const Particles& all, const std::vector<std::size_t>& chosen) {
  Particles part = all;
  part.count = chosen.size();
  part.position = gather(all.position, chosen, 3);
  for (Column Particles::*column :
       {&Particles::smoothing_length, &Particles::weight, &Particles::color, &Particles::intensity,
        &Particles::sort_field}) {
    part.*column = gather(all.*column, chosen, 1);
  }
  return part;
}

// Beyond this distance a splat is below 1e-17 of white: less than the reference itself keeps.
double farthest_reach(const reference::Splat& splat) {
  double strongest = 1;
  for (int c = 0; c < 3; ++c) {
    strongest =
        std::max({strongest, splat.weight * splat.emission[c], splat.weight * splat.absorption[c]});
  }
  return splat.sigma * std::sqrt(40 + std::log(strongest)) + 2;
}

bool can_reach(const reference::Splat& splat, const Rectangle& part) {
  const double radius = farthest_reach(splat);
  return splat.x + radius >= part.x && splat.x - radius <= part.x + part.width &&
         splat.y + radius >= part.y && splat.y - radius <= part.y + part.height;
}

// chosen[part]: the component's particles that can be seen there, in file order.
std::vector<std::vector<std::size_t>> choose_particles(const Frame& frame,
                                                       const DrawnComponent& component,
                                                       const std::vector<Rectangle>& parts) {
  std::vector<std::vector<std::size_t>> chosen(parts.size());
  Frame some = frame;
  for (std::size_t first = 0; first < component.particles.count; first += most_particles) {
    some.components = {component};
    some.components[0].particles = slice(
        component.particles, first, std::min(most_particles, component.particles.count - first));
    for (const reference::Splat& splat : reference::project(some)) {
      for (std::size_t p = 0; p < parts.size(); ++p) {
        if (can_reach(splat, parts[p]))
          chosen[p].push_back(first + static_cast<std::size_t>(splat.particle));
      }
    }
  }
  return chosen;
}

}  // namespace

double FrameError::rms() const {
  return values > 0 ? std::sqrt(squares / values) : 0;
}

void FrameError::join(const FrameError& other) {
  maximum = std::max(maximum, other.maximum);
  brightest = std::max(brightest, other.brightest);
  squares += other.squares;
  values += other.values;
}

FrameError measure_error(const Image& image, const Rectangle& image_crop,
                         const ReferenceImage& reference, const Rectangle& part) {
  FrameError error;
  error.values = 3.0 * part.width * part.height;
  for (int y = 0; y < part.height; ++y) {
    const float* found = image.at(part.x - image_crop.x, part.y - image_crop.y + y);
    const double* expected = reference.pixels.data() +
                             4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width);
    for (int i = 0; i < 4 * part.width; ++i) {
      if (i % 4 == 3) continue;
      const double scale = std::max(1.0, std::abs(expected[i]));
      double off = std::abs(static_cast<double>(found[i]) - expected[i]) / scale;
      if (!std::isfinite(off)) off = std::numeric_limits<double>::infinity();
      error.maximum = std::max(error.maximum, off);
      error.brightest = std::max(error.brightest, expected[i]);
      error.squares += off * off;
    }
  }
  return error;
}

std::vector<ReferenceImage> draw_reference_parts(const Frame& frame,
                                                 const std::vector<Rectangle>& parts) {
  std::vector<Frame> part_frames;
  for (const Rectangle& part : parts) {
    part_frames.push_back(frame);
    part_frames.back().crop = part;
  }
  for (std::size_t c = 0; c < frame.components.size(); ++c) {
    const auto chosen = choose_particles(frame, frame.components[c], parts);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      part_frames[p].components[c].particles = gather(frame.components[c].particles, chosen[p]);
    }
  }
  std::vector<ReferenceImage> images;
  for (const Frame& part : part_frames)
    images.push_back(reference::render(part));
  return images;
}

std::vector<Rectangle> sample_parts(const Rectangle& crop, int side) {
  const int width = std::min(side, crop.width), height = std::min(side, crop.height);
  const int free_x = crop.width - width, free_y = crop.height - height;
  std::vector<Rectangle> parts;
  constexpr std::array<std::array<double, 2>, 4> places = {
      {{0.5, 0.5}, {0.0, 0.0}, {0.3, 0.65}, {1.0, 0.4}}};
  for (const auto& [across, down] : places) {
    parts.push_back({crop.x + static_cast<int>(across * free_x),
                     crop.y + static_cast<int>(down * free_y), width, height});
  }
  return parts;
}

}  // namespace splotchcl::bench
