#include "view/probe.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/projection.h"

namespace splotchcl::view {
namespace {

// A pointer is not put down more exactly, as a part of the picture's width.
constexpr double pointer_radius = 0.01;

struct Candidate {
  double depth = 0, light = 0;
  Vec3 position;
};

// Matter over the area of its cloud, which is what makes it bright.
double light_of(const DrawnComponent& component, std::size_t i, double size) {
  const Column& weight = component.particles.weight;
  const double matter =
      component.weight == WeightModel::mass && !weight.is_absent() ? weight[i] : 1;
  return matter * component.brightness / (component.reference_column * size * size);
}

void add_candidates(const Frame& frame, const DrawnComponent& component, double x, double y,
                    std::vector<Candidate>& candidates) {
  const Particles& particles = component.particles;
  const double pointer = pointer_radius * frame.width;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Vec3 offset = {
        {particles.position[3 * i], particles.position[3 * i + 1], particles.position[3 * i + 2]}};
    const Vec3 position = particles.origin + offset;
    const auto place = project_point(along_axes(position - frame.camera.position, frame.camera),
                                     frame.camera, frame.projection);
    if (!place) continue;
    const double size = component.size_factor * particles.smoothing_length[i];
    const double radius = pointer + frame.kernel.width * size * place->pixels_per_length;
    const double away = std::hypot(place->x - x, place->y - y) / radius;
    if (!(away < 1)) continue;
    candidates.push_back({place->depth, light_of(component, i, size) * (1 - away), position});
  }
}

}  // namespace

std::optional<Vec3> pick_particle(const Frame& frame, double x, double y) {
  std::vector<Candidate> candidates;
  for (const DrawnComponent& component : frame.components)
    add_candidates(frame, component, x, y, candidates);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.depth < b.depth; });
  double half = 0;
  for (const Candidate& candidate : candidates)
    half += 0.5 * candidate.light;
  for (const Candidate& candidate : candidates) {
    half -= candidate.light;
    if (half <= 0) return std::optional<Vec3>(std::in_place, candidate.position);
  }
  return std::nullopt;
}

namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 position_of(const Particles& particles, std::size_t i) {
  const Vec3 offset = {
      {particles.position[3 * i], particles.position[3 * i + 1], particles.position[3 * i + 2]}};
  return particles.origin + offset;
}

double distance_between(const Vec3& a, const Vec3& b) {
  return std::hypot(a.a[0] - b.a[0], a.a[1] - b.a[1], a.a[2] - b.a[2]);
}

// The column through a cloud's middle (docs/scene.md).
double central_column(const DrawnComponent& component, std::size_t i, double size, double sigma) {
  const Column& weight = component.particles.weight;
  const double value = weight.is_absent() ? 1 : weight[i];
  double column = value / size;
  if (component.weight == WeightModel::mass) column = value / (pi * sigma * sigma);
  if (component.weight == WeightModel::density) column = value * sigma * std::sqrt(pi);
  return column * component.particles_per_drawn;
}

ProbedComponent probe_component(const Frame& frame, const DrawnComponent& component, double x,
                                double y) {
  // Beyond that a cloud has nothing.
  constexpr double most_sigmas = 4;
  ProbedComponent probed{component.name, 0, std::nullopt};
  double values = 0, weights = 0;
  const Particles& particles = component.particles;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const auto place =
        project_point(along_axes(position_of(particles, i) - frame.camera.position, frame.camera),
                      frame.camera, frame.projection);
    if (!place) continue;
    const double size = component.size_factor * particles.smoothing_length[i];
    const double sigma = frame.kernel.width * size;
    const double away = std::hypot(place->x - x, place->y - y) / place->pixels_per_length / sigma;
    if (!(away < most_sigmas)) continue;
    const double column = central_column(component, i, size, sigma) * std::exp(-away * away);
    probed.column += column;
    if (particles.color.is_absent() || !std::isfinite(particles.color[i])) continue;
    values += column * particles.color[i];
    weights += column;
  }
  if (weights > 0) probed.mean = values / weights;
  return probed;
}

}  // namespace

Probe probe(const Frame& frame, double x, double y) {
  Probe result;
  result.position = pick_particle(frame, x, y);
  if (result.position) result.distance = distance_between(*result.position, frame.camera.position);
  for (const DrawnComponent& component : frame.components)
    result.components.push_back(probe_component(frame, component, x, y));
  return result;
}

std::vector<double> some_places(const Frame& frame, std::size_t most) {
  std::vector<double> places;
  const std::size_t of_each = most / std::max<std::size_t>(1, frame.components.size());
  for (const DrawnComponent& component : frame.components) {
    const Particles& particles = component.particles;
    const std::size_t count = std::min(of_each, particles.count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 place = position_of(particles, k * particles.count / count);
      places.insert(places.end(), place.a, place.a + 3);
    }
  }
  return places;
}

}  // namespace splotchcl::view
