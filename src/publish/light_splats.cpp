#include "publish/light_splats.h"

#include <algorithm>
#include <cstddef>

#include "parallel/for_blocks.h"
#include "scene/particle_rules.h"
#include "scene/plan/light_structure.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

constexpr std::size_t particles_at_once = 1 << 15;

// What the scene's matter does to light, per unit of its column.
struct Matter {
  double emitted = 0, absorbed = 0;
};

// `own` and `of_palette` are what the particle and the absorption palette say, and `column` how
// much of it there is.
Matter matter_of(const DrawnComponent& component, double own, double of_palette, double column) {
  const double emitted = component.brightness * own;
  switch (component.absorption.kind) {
    case Absorption::Kind::none:
      break;
    case Absorption::Kind::as_emission:
      return {emitted, component.brightness * of_palette};
    case Absorption::Kind::factor:
      return {emitted, component.absorption.factor * of_palette};
    case Absorption::Kind::gray: {
      const double amplitude = emitted * column;
      const double part = amplitude > 0 ? amplitude / (amplitude + component.absorption.factor) : 0;
      return {emitted * part, emitted};
    }
  }
  return {emitted, 0};
}

LightSplat splat_of(const DrawnComponent& component, std::size_t i, double kernel_width,
                    const Vec3& origin, bool ordered) {
  const Particles& particles = component.particles;
  const double h = component.size_factor * static_cast<double>(particles.smoothing_length[i]);
  const double sigma = kernel_width * h;
  const double weight =
      particles.weight.is_absent() ? 1.0 : static_cast<double>(particles.weight[i]);
  double column = central_column(component.weight, weight, h, sigma) / component.reference_column;
  if (!particles.intensity.is_absent())
    column *= normalized(static_cast<double>(particles.intensity[i]), component.intensity);
  const double place = particles.color.is_absent()
                           ? 0.0
                           : normalized(static_cast<double>(particles.color[i]), component.color);
  const Palette& palette = component.palette;
  const std::array<double, 3> emission = sample_knots(palette.emission, place);
  const std::array<double, 3> absorption =
      sample_knots(palette.has_own_absorption() ? palette.absorption : palette.emission, place);
  LightSplat splat;
  splat.sigma = static_cast<float>(sigma);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    splat.place[axis] = static_cast<float>((particles.origin.a[axis] - origin.a[axis]) +
                                           static_cast<double>(particles.position[3 * i + axis]));
    const double own = particles.color_vector.is_absent()
                           ? 1.0
                           : static_cast<double>(particles.color_vector[3 * i + axis]);
    const double of_palette = absorption[axis] * (palette.has_own_absorption() ? 1.0 : own);
    const Matter matter = matter_of(component, emission[axis] * own, of_palette, column);
    splat.light[axis] = static_cast<float>(matter.emitted * column);
    if (ordered) splat.depth[axis] = static_cast<float>(matter.absorbed * column);
  }
  return splat;
}

}  // namespace

Vec3 look_at_point(const CameraFrame& camera) {
  Vec3 point = camera.position;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.a[axis] += camera.look_at_distance * camera.forward.a[axis];
  return point;
}

bool is_ordered(const Frame& frame) {
  return find_light_structure(frame).light == LightPlan::ordered;
}

std::vector<LightSplat> light_splats(const Frame& frame) {
  const Vec3 origin = look_at_point(frame.camera);
  const bool ordered = is_ordered(frame);
  std::vector<LightSplat> splats;
  splats.reserve(particle_count(frame));
  for (const DrawnComponent& component : frame.components) {
    const std::size_t first = splats.size();
    splats.resize(first + component.particles.count);
    for_blocks(component.particles.count, particles_at_once,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   // Those that are left out have no width.
                   if (is_bad(component.particles, i)) continue;
                   splats[first + i] = splat_of(component, i, frame.kernel.width, origin, ordered);
                 }
               });
  }
  splats.erase(
      std::remove_if(splats.begin(), splats.end(),
                     [](const LightSplat& splat) {
                       const auto& [red, green, blue] = splat.light;
                       const auto& [of_red, of_green, of_blue] = splat.depth;
                       const float most = std::max({red, green, blue, of_red, of_green, of_blue});
                       return !(splat.sigma > 0) || !(most > 0);
                     }),
      splats.end());
  return splats;
}

}  // namespace splotchcl
