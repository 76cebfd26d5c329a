#include "view/pick.h"

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

}  // namespace splotchcl::view
