// The rules for particles are written out here once more, on purpose: what src/scene and the
// kernels say of bad particles and weights is tested against this file.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>

#include "reference/depth_key.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"
#include "splotchcl/reference.h"

namespace splotchcl::reference {
namespace {

// One particle's values as they are stored.
struct Particle {
  float position[3];
  float smoothing_length;
  float weight;
  float color;
  float color_vector[3];
  float intensity;
  float sort_field;
};

// What a component does not have counts as 1 where it is a factor.
float value_or(const Column& column, std::size_t i, float value_when_absent) {
  return column.is_absent() ? value_when_absent : column[i];
}

Particle particle_at(const Particles& particles, std::size_t i) {
  Particle p;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    p.position[axis] = particles.position[3 * i + axis];
    p.color_vector[axis] = value_or(particles.color_vector, 3 * i + axis, 1);
  }
  p.smoothing_length = particles.smoothing_length[i];
  p.weight = value_or(particles.weight, i, 1);
  p.color = value_or(particles.color, i, 0);
  p.intensity = value_or(particles.intensity, i, 1);
  p.sort_field = value_or(particles.sort_field, i, 0);
  return p;
}

bool is_bad(const Particle& p) {
  const bool all_finite = std::isfinite(p.position[0]) && std::isfinite(p.position[1]) &&
                          std::isfinite(p.position[2]) && std::isfinite(p.smoothing_length) &&
                          std::isfinite(p.weight) && std::isfinite(p.color) &&
                          std::isfinite(p.intensity) && std::isfinite(p.sort_field);
  const bool has_color =
      std::all_of(std::begin(p.color_vector), std::end(p.color_vector),
                  [](float channel) { return std::isfinite(channel) && channel >= 0; });
  return !all_finite || !has_color || p.smoothing_length <= 0 || p.weight < 0;
}

// Along the camera's right, down and forward axes, in world lengths.
Vec3 from_camera(const Particle& p, const Vec3& origin, const CameraFrame& camera) {
  double d[3];
  for (int axis = 0; axis < 3; ++axis) {
    // The two large numbers first, so that what is left is small when p is added.
    d[axis] = (origin.a[axis] - camera.position.a[axis]) + static_cast<double>(p.position[axis]);
  }
  const auto along = [&d](const Vec3& axis) {
    return d[0] * axis.a[0] + d[1] * axis.a[1] + d[2] * axis.a[2];
  };
  return {{along(camera.right), along(camera.down), along(camera.forward)}};
}

// w as WeightModel defines it, for a particle of this mass or density (constant: a factor).
double column_through_center(WeightModel model, double value, double h, double sigma) {
  constexpr double pi = 3.14159265358979323846;
  switch (model) {
    case WeightModel::mass:
      return value / (pi * sigma * sigma);
    case WeightModel::density:
      return value * sigma * std::sqrt(pi);
    case WeightModel::constant:
      return value / h;
  }
  return 0;
}

// Emission and absorption per unit of X; the weight stays in X.
void color_splat(Splat& splat, const Particle& p, const DrawnComponent& component) {
  const Palette& palette = component.palette;
  const bool has_color = !component.particles.color.is_absent();
  const double palette_position =
      has_color ? normalized(static_cast<double>(p.color), component.color) : 0.0;
  auto emitted = sample_knots(palette.emission, palette_position);
  for (std::size_t c = 0; c < 3; ++c)
    emitted[c] *= static_cast<double>(p.color_vector[c]);
  const auto absorbed =
      palette.has_own_absorption() ? sample_knots(palette.absorption, palette_position) : emitted;
  const double factor = component.absorption.factor;
  for (std::size_t c = 0; c < 3; ++c) {
    const double e = component.brightness * emitted[c];
    splat.emission[c] = e;
    switch (component.absorption.kind) {
      case Absorption::Kind::as_emission:
        splat.absorption[c] = component.brightness * absorbed[c];
        break;
      case Absorption::Kind::none:
        splat.absorption[c] = 0;
        break;
      case Absorption::Kind::factor:
        splat.absorption[c] = factor * absorbed[c];
        break;
      case Absorption::Kind::gray: {
        // As in the original the source is e / (e + factor) with e the cloud's whole
        // amplitude, weight included, so it is not the same for all particles.
        const double amplitude = e * splat.weight;
        splat.absorption[c] = e;
        splat.emission[c] = amplitude > 0 ? e * (amplitude / (amplitude + factor)) : 0;
        break;
      }
    }
  }
}

// The bits of a field's value, turned so that unsigned integers have the order of the values.
std::uint64_t field_key(float value) {
  if (value == 0) value = 0;  // -0 as well
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

void put_on_face(Splat& splat, const Projected& place, const Frame& frame) {
  const CameraFrame& camera = frame.camera;
  const FaceEllipse ellipse =
      face_ellipse(place, splat.sigma, camera, frame.kernel.sampling == Sampling::mean);
  splat.sigma = ellipse.sigma_y;
  splat.stretch = ellipse.sigma_x / ellipse.sigma_y;
  splat.on_face = {camera.focal_pixels,   camera.center_x,   camera.center_y,
                   ellipse.squared_width, ellipse.footprint, ellipse.secant2};
}

// sigma^2 of the circle of confusion of a lens: a Gaussian of the disc's second moment.
double squared_blur(double depth, const Frame& frame) {
  const Lens& lens = frame.lens;
  if (lens.aperture == 0) return 0;
  const double at_focus = lens.aperture * (depth - lens.focus) / depth;
  const double diameter = at_focus * (frame.camera.focal_pixels / lens.focus);
  const double variance = diameter * diameter / 16;
  return 2 * variance;
}

// Smoothly from 0 to 1.
double rising(double part) {
  const double u = std::clamp(part, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

double part_after_fade(double depth, const Frame& frame) {
  const auto [near_length, far_length] = frame.fade;
  double part = 1;
  if (near_length > 0) part *= rising((depth - frame.near_limit.value_or(0)) / near_length);
  if (far_length > 0) part *= rising((frame.far_limit.value() - depth) / far_length);
  return part;
}

// kernel.min_radius takes light from columns by their widths' ratio, kernel.footprint and lenses by
// that of their areas, which keeps light.
struct Widened {
  double sigma = 0, column = 1;
};
Widened widened_splat(double sigma, double depth, const Frame& frame) {
  const KernelSettings& kernel = frame.kernel;
  const double least = std::hypot(sigma, kernel.width * kernel.min_radius_pixels);
  const double spread2 =
      2 * kernel.footprint_pixels * kernel.footprint_pixels + squared_blur(depth, frame);
  const double widened2 = least * least + spread2;
  return {std::sqrt(widened2), (sigma / least) * (least * least / widened2)};
}

Splat splat_of(const Particle& p, const Projected& place, double h, const DrawnComponent& component,
               const Frame& frame) {
  const double h_pixels = h * place.pixels_per_length;
  const Widened widened = widened_splat(frame.kernel.width * h_pixels, place.depth, frame);

  Splat splat;
  splat.x = place.x;
  splat.y = place.y;
  splat.sigma = widened.sigma;
  if (frame.projection == Projection::equirectangular) {
    splat.sigma = std::min(splat.sigma, widest_in_panorama(frame.camera));
    const PanoramaEllipse ellipse = panorama_ellipse(place, splat.sigma, frame.camera);
    splat.y = ellipse.y;
    splat.stretch = ellipse.stretch;
  }
  if (frame.projection == Projection::cube) put_on_face(splat, place, frame);
  const double w = column_through_center(component.weight, static_cast<double>(p.weight), h,
                                         frame.kernel.width * h);
  splat.weight =
      w / component.reference_column * widened.column * part_after_fade(place.depth, frame);
  // An absent intensity is 1 without being scaled.
  if (!component.particles.intensity.is_absent()) {
    splat.weight *= normalized(static_cast<double>(p.intensity), component.intensity);
  }
  color_splat(splat, p, component);
  return splat;
}

// A cloud around the camera: up to 4 sigma from it what rays find, from 12 on a splat like others,
// and between them parts of both.
constexpr double all_ray = 4, all_splat = 12;

double ray_part(double distance_in_sigma) {
  const double u = std::clamp((distance_in_sigma - all_ray) / (all_splat - all_ray), 0.0, 1.0);
  return 1 - u * u * (3 - 2 * u);
}

double depth_from(const Vec3& from, Projection projection) {
  if (!is_wide_angle(projection)) return from.a[2];
  return std::hypot(from.a[0], from.a[1], from.a[2]);
}

// The same as a splat where the projection shows it as one.
Splat splat_around(const Particle& p, const Vec3& from, double h, const DrawnComponent& component,
                   const Frame& frame) {
  const double sigma = frame.kernel.width * h;
  const std::optional<Projected> place = project_point(from, frame.camera, frame.projection);
  Splat splat;
  splat.sigma = 1;
  if (place) splat = splat_of(p, *place, h, component, frame);
  splat.weight = column_through_center(component.weight, static_cast<double>(p.weight), h, sigma) /
                 component.reference_column;
  if (!component.particles.intensity.is_absent())
    splat.weight *= normalized(static_cast<double>(p.intensity), component.intensity);
  splat.weight *= part_after_fade(depth_from(from, frame.projection), frame);
  color_splat(splat, p, component);
  const Vec3 seen = seen_by_eye(from, frame.camera, frame.projection);
  double distance2 = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    splat.center.a[axis] = seen.a[axis] / sigma;
    distance2 += splat.center.a[axis] * splat.center.a[axis];
  }
  splat.is_around = true;
  // On a face of a cube splats are what rays find, too.
  splat.ray_part = frame.projection == Projection::cube ? 1 : ray_part(std::sqrt(distance2));
  // What widens splats takes away from their columns.
  splat.splat_part =
      place ? (1 - splat.ray_part) *
                  widened_splat(sigma * place->pixels_per_length, place->depth, frame).column
            : 0;
  return splat;
}

// Whether it may be around the camera, of an orthographic one nothing is.
bool is_around(const Vec3& from, double h, const Frame& frame) {
  if (!frame.through_clouds || frame.projection == Projection::orthographic) return false;
  const double reach = all_splat * frame.kernel.width * h;
  return from.a[0] * from.a[0] + from.a[1] * from.a[1] + from.a[2] * from.a[2] < reach * reach;
}

// Of clouds around the camera those limits hold that the scene sets.
bool is_within_set_limits(const Depth& depth, const Frame& frame, const DepthKeyScale& scale) {
  return !(frame.near_limit && depth.key < scale.near_key) &&
         !(frame.far_limit && depth.key > scale.far_key);
}

// The splat and its copies a period to the left and right, and between them those that are
// mirrored over the poles, as far as they reach the picture. At eight sigmas a cloud has 1e-28 of
// its peak left.
void push_copies(Splat splat, const Frame& frame, std::vector<Splat>& splats) {
  if (splat.splat_part == 0) {  // rays alone find it, wherever they go
    splats.push_back(splat);
    return;
  }
  const double half_period = 0.5 * period_along_x(frame.camera, frame.projection);
  const double reach = 8 * splat.sigma + 2, reach_x = 8 * splat.stretch * splat.sigma + 2;
  const double x = splat.x;
  const std::vector<double> straight = {splat.y};
  std::vector<double> mirrored;
  for (const double y : mirrored_over_poles(splat.y, frame.camera)) {
    if (y + reach >= 0 && y - reach <= frame.height) mirrored.push_back(y);
  }
  const double first = std::ceil((-reach_x - x) / half_period);
  const double last = std::floor((frame.width + reach_x - x) / half_period);
  const std::size_t before = splats.size();
  for (double copy = first; copy <= last; ++copy) {
    for (const double y : std::fmod(copy, 2) != 0 ? mirrored : straight) {
      splat.x = x + copy * half_period;
      splat.y = y;
      splats.push_back(splat);
      splat.ray_part = 0;  // which is that of all copies
    }
  }
  if (splats.size() == before) splats.push_back(splat);
}

void project_component(const DrawnComponent& component, const Frame& frame,
                       std::uint64_t first_particle, std::vector<Splat>& splats) {
  const Particles& particles = component.particles;
  const DepthKeyScale depths = make_depth_key_scale(frame, component);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Particle p = particle_at(particles, i);
    if (is_bad(p)) continue;
    const Depth depth = depth_of(p.position, depths);
    const Vec3 from = from_camera(p, particles.origin, frame.camera);
    const double h = component.size_factor * static_cast<double>(p.smoothing_length);
    Splat splat;
    if (is_around(from, h, frame)) {
      if (!is_within_set_limits(depth, frame, depths)) continue;
      splat = splat_around(p, from, h, component, frame);
    } else {
      if (!is_within_limits(depth, p.smoothing_length, depths)) continue;
      const std::optional<Projected> place = project_point(from, frame.camera, frame.projection);
      if (!place) continue;
      splat = splat_of(p, *place, h, component, frame);
    }
    splat.key = frame.sort.by == SortOrder::By::depth ? depth.key : field_key(p.sort_field);
    splat.particle = first_particle + i;
    if (frame.projection == Projection::equirectangular) {
      push_copies(splat, frame, splats);
    } else {
      splats.push_back(splat);
    }
  }
}

}  // namespace

std::vector<Splat> project(const Frame& frame) {
  std::vector<Splat> splats;
  std::uint64_t first_particle = 0;
  for (const DrawnComponent& component : frame.components) {
    project_component(component, frame, first_particle, splats);
    first_particle += component.particles.count;
  }
  return splats;
}

std::uint64_t count_bad(const Frame& frame) {
  std::uint64_t bad = 0;
  for (const DrawnComponent& component : frame.components) {
    for (std::size_t i = 0; i < component.particles.count; ++i) {
      if (is_bad(particle_at(component.particles, i))) ++bad;
    }
  }
  return bad;
}

}  // namespace splotchcl::reference
