#include "surroundings/cloud_around.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "scene/constants.h"
#include "scene/particle_rules.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

// The mean of exp(-(t - center)^2 / sigma^2) over a pixel.
double mean_profile(double center, double sigma, int pixel) {
  // Turned so that both ends count from below: differences of erfc keep their digits.
  double low = (pixel - center) / sigma, high = (pixel + 1 - center) / sigma;
  if (low + high < 0) {
    std::swap(low, high);
    low = -low;
    high = -high;
  }
  return 0.5 * std::sqrt(pi) * sigma * (std::erfc(low) - std::erfc(high));
}

// The mean of exp(-u^2) over a pixel's width, of its value at the pixel's center: u^2 there.
double mean_of_value(double u2, double inverse_sigma2) {
  return 1 + inverse_sigma2 * ((u2 - 0.5) / 6 + inverse_sigma2 * ((u2 * (4 * u2 - 12) + 3) / 480));
}

double splat_column(const SplatAround& splat, int x, int y, double farthest2, Sampling sampling,
                    double wide_sigma) {
  const double dx = (x + 0.5 - splat.x) / splat.sigma_x, dy = (y + 0.5 - splat.y) / splat.sigma_y;
  const double x2 = dx * dx, y2 = dy * dy;
  const bool is_wide = splat.sigma_x > wide_sigma && splat.sigma_y > wide_sigma;
  if (sampling == Sampling::mean && !is_wide)
    return mean_profile(splat.x, splat.sigma_x, x) * mean_profile(splat.y, splat.sigma_y, y);
  if (x2 + y2 > farthest2) return 0;
  const double value = std::exp(-(x2 + y2));
  if (sampling == Sampling::center) return value;
  return value * mean_of_value(x2, 1 / (splat.sigma_x * splat.sigma_x)) *
         mean_of_value(y2, 1 / (splat.sigma_y * splat.sigma_y));
}

bool is_cut_away(const SplatAround& splat, int x, int y, const KernelSettings& kernel) {
  if (!kernel.cut) return false;
  const double dx = (x + 0.5 - splat.x) / splat.sigma_x, dy = (y + 0.5 - splat.y) / splat.sigma_y;
  if (dx * dx + dy * dy <= *kernel.cut * *kernel.cut) return false;
  const bool holds_center = std::floor(splat.x) == x && std::floor(splat.y) == y;
  return !(kernel.sampling == Sampling::mean && holds_center);
}

Vec3 from_camera(const DrawnComponent& component, const Frame& frame, std::size_t i) {
  using namespace boost::qvm;
  const Particles& particles = component.particles;
  Vec3 offset = particles.origin - frame.camera.position;
  for (std::size_t axis = 0; axis < 3; ++axis)
    offset.a[axis] += static_cast<double>(particles.position[3 * i + axis]);
  return along_axes(offset, frame.camera);
}

// E w and A w (light_model.h, Absorption).
void set_amplitudes(const DrawnComponent& component, std::size_t i, double weight,
                    CloudAround& cloud) {
  const Particles& particles = component.particles;
  const Palette& palette = component.palette;
  const double place = particles.color.is_absent()
                           ? 0.0
                           : normalized(static_cast<double>(particles.color[i]), component.color);
  std::array<double, 3> emitted = sample_knots(palette.emission, place);
  for (std::size_t c = 0; c < 3 && !particles.color_vector.is_absent(); ++c)
    emitted[c] *= static_cast<double>(particles.color_vector[3 * i + c]);
  const std::array<double, 3> absorbed =
      palette.has_own_absorption() ? sample_knots(palette.absorption, place) : emitted;
  const Absorption& absorption = component.absorption;
  for (std::size_t c = 0; c < 3; ++c) {
    const double amplitude = weight * component.brightness * emitted[c];
    cloud.emission[c] = amplitude;
    switch (absorption.kind) {
      case Absorption::Kind::as_emission:
        cloud.absorption[c] = weight * component.brightness * absorbed[c];
        break;
      case Absorption::Kind::none:
        break;
      case Absorption::Kind::factor:
        cloud.absorption[c] = weight * absorption.factor * absorbed[c];
        break;
      case Absorption::Kind::gray:
        cloud.absorption[c] = amplitude;
        cloud.emission[c] =
            amplitude > 0 ? amplitude * (amplitude / (amplitude + absorption.factor)) : 0;
    }
  }
}

// At eight sigma a cloud has 1e-28 of its peak left.
void set_splats(const Projected& place, double sigma, const Frame& frame, CloudAround& cloud) {
  SplatAround splat = {place.x, place.y, sigma, sigma};
  if (frame.projection != Projection::equirectangular) {
    cloud.splats = {splat};
    return;
  }
  sigma = std::min(sigma, widest_in_panorama(frame.camera));
  const PanoramaEllipse ellipse = panorama_ellipse(place, sigma, frame.camera);
  splat.sigma_y = sigma;
  splat.sigma_x = sigma * ellipse.stretch;
  const double reach = 8 * sigma + 2;
  const std::vector<double> straight = {ellipse.y};
  std::vector<double> mirrored;
  for (const double y : mirrored_over_poles(ellipse.y, frame.camera)) {
    if (y + reach >= 0 && y - reach <= frame.height) mirrored.push_back(y);
  }
  const double half_period = 0.5 * period_along_x(frame.camera, frame.projection);
  const double reach_x = 8 * splat.sigma_x + 2;
  const double first = std::ceil((-reach_x - place.x) / half_period);
  const double last = std::floor((frame.width + reach_x - place.x) / half_period);
  for (double copy = first; copy <= last; ++copy) {
    splat.x = place.x + copy * half_period;
    for (const double y : std::fmod(copy, 2) != 0 ? mirrored : straight) {
      splat.y = y;
      cloud.splats.push_back(splat);
    }
  }
}

// Of a range of pixels, in pixels; 0 within.
double distance_from(double place, int first, int count) {
  return std::max({first - place, place - (first + count), 0.0});
}

}  // namespace

bool has_clouds_around(const Frame& frame) {
  return frame.through_clouds && frame.projection != Projection::orthographic;
}

// The first derivative that is left out is below 3.8e-4 / sigma^6.
double sigma_of_means_by_values(double error) {
  return std::pow(3.8e-4 / error, 1.0 / 6);
}

double ray_part(double distance_in_sigma) {
  const double u = std::clamp((distance_in_sigma - all_ray) / (all_splat - all_ray), 0.0, 1.0);
  return 1 - u * u * (3 - 2 * u);
}

double ray_column(const Vec3& center, const Vec3& direction, double farthest2) {
  using namespace boost::qvm;
  // erfc(6) is below what doubles tell 1 from.
  constexpr double all_in_front = 6;
  const double distance2 = mag_sqr(cross(center, direction));
  if (distance2 > farthest2) return 0;
  const double before = dot(center, direction);
  if (before > all_in_front) return std::exp(-distance2);
  return 0.5 * std::exp(-distance2) * std::erfc(-before);
}

CloudAround cloud_around(const DrawnComponent& component, const Frame& frame, std::size_t i) {
  const Particles& particles = component.particles;
  const double h = component.size_factor * static_cast<double>(particles.smoothing_length[i]);
  const double sigma = frame.kernel.width * h;
  double weight = central_column(
      component.weight, particles.weight.is_absent() ? 1 : static_cast<double>(particles.weight[i]),
      h, sigma);
  weight /= component.reference_column;
  if (!particles.intensity.is_absent())
    weight *= normalized(static_cast<double>(particles.intensity[i]), component.intensity);

  CloudAround cloud;
  const Vec3 place = from_camera(component, frame, i);
  using namespace boost::qvm;
  cloud.center = seen_by_eye(place, frame.camera, frame.projection) / sigma;
  // On a face of a cube splats are what rays find, too.
  cloud.ray = frame.projection == Projection::cube ? 1 : ray_part(mag(cloud.center));
  const bool is_flat = !is_wide_angle(frame.projection);
  weight *= part_after_fade(frame, is_flat ? place.a[2] : mag(place));
  set_amplitudes(component, i, weight, cloud);
  if (cloud.ray == 1) return cloud;
  if (const auto projected = project_point(place, frame.camera, frame.projection)) {
    const DrawnWidth drawn = drawn_width(sigma * projected->pixels_per_length, frame.kernel,
                                         lens_sigma(frame, projected->pixels_per_length));
    cloud.splat = (1 - cloud.ray) * drawn.column;
    set_splats(*projected, drawn.sigma, frame, cloud);
  }
  return cloud;
}

double column_around(const CloudAround& cloud, int x, int y, const Vec3& direction,
                     const KernelSettings& kernel, double wide_sigma) {
  double column =
      cloud.ray > 0 ? cloud.ray * ray_column(cloud.center, direction, cloud.farthest2) : 0;
  for (const SplatAround& splat : cloud.splats) {
    if (is_cut_away(splat, x, y, kernel)) continue;
    column += cloud.splat * splat_column(splat, x, y, cloud.farthest2, kernel.sampling, wide_sigma);
  }
  return column;
}

double widest_angle(const Frame& frame) {
  if (frame.projection != Projection::perspective && frame.projection != Projection::cube)
    return pi;
  double widest = 0;
  for (const double x : {0.0, static_cast<double>(frame.width)}) {
    for (const double y : {0.0, static_cast<double>(frame.height)}) {
      const Vec3 corner = direction_at(x, y, frame.camera, frame.projection);
      widest = std::max(widest, std::acos(std::clamp(corner.a[2], -1.0, 1.0)));
    }
  }
  return widest;
}

// A ray that is at least the angle a from a cloud's center, a < pi / 2, passes it at D sin a or
// more; one that leads away from it finds exp(-D^2) / 2 at most.
double largest_column_around(const CloudAround& cloud, const Frame& frame, double widest_angle) {
  using boost::qvm::mag;
  const double distance = mag(cloud.center);
  double largest = cloud.ray;
  if (distance > 0) {
    const double off_axis = std::acos(std::clamp(cloud.center.a[2] / distance, -1.0, 1.0));
    const double angle = std::clamp(off_axis - widest_angle, 0.0, 0.5 * pi);
    const double beside = distance * std::sin(angle);
    largest *= std::exp(-beside * beside);
  }
  for (const SplatAround& splat : cloud.splats) {
    const double dx = distance_from(splat.x, 0, frame.width) / splat.sigma_x;
    const double dy = distance_from(splat.y, 0, frame.height) / splat.sigma_y;
    largest += cloud.splat * std::exp(-(dx * dx + dy * dy));
  }
  return largest;
}

}  // namespace splotchcl
