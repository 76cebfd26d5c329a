#include "surroundings/cloud_around.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <limits>

#include "scene/constants.h"
#include "scene/particle_rules.h"
#include "scene/projection.h"
#include "scene/scalar_map.h"

namespace splotchcl {
namespace {

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

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a.a[0] - b.a[0], a.a[1] - b.a[1], a.a[2] - b.a[2]);
}

// Of those all over the picture, its middle and corners among them, in radians.
double widest_pixel(const Frame& frame) {
  constexpr int steps = 16;
  const auto towards = [&frame](double x, double y) {
    return direction_at(x, y, frame.camera, frame.projection);
  };
  double widest = 0;
  for (int row = 0; row <= steps; ++row) {
    for (int column = 0; column <= steps; ++column) {
      const double x = (frame.width - 1.0) * column / steps;
      const double y = (frame.height - 1.0) * row / steps;
      const Vec3 corner = towards(x, y);
      widest = std::max(
          {widest, distance(corner, towards(x + 1, y)), distance(corner, towards(x, y + 1))});
    }
  }
  return widest;
}

// Whether a disc of this radius in sigma reaches pixels of the picture.
bool is_in_picture(const SplatAround& disc, double radius, const Frame& frame) {
  const auto reaches = [radius](double place, double sigma, int pixels) {
    return place + radius * sigma > 0 && place - radius * sigma < pixels;
  };
  return reaches(disc.x, disc.sigma_x, frame.width) && reaches(disc.y, disc.sigma_y, frame.height);
}

// Nothing between the pixels tells where a disc ends.
constexpr double single_pixels = 0.5;

bool ends_in_picture(const SplatAround& splat, const Frame& frame) {
  return frame.kernel.cut && is_in_picture(splat, *frame.kernel.cut, frame);
}

bool ends_in_picture(const CloudAround& cloud, const Frame& frame) {
  return std::any_of(cloud.splats.begin(), cloud.splats.end(),
                     [&frame](const SplatAround& splat) { return ends_in_picture(splat, frame); });
}

double narrowest_of(const SplatAround& splat, const Frame& frame) {
  if (ends_in_picture(splat, frame)) return single_pixels;
  return std::min(splat.sigma_x, splat.sigma_y);
}

}  // namespace

bool has_clouds_around(const Frame& frame) {
  return frame.through_clouds && frame.projection != Projection::orthographic;
}

double ray_part(double distance_in_sigma) {
  const double u = std::clamp((distance_in_sigma - all_ray) / (all_splat - all_ray), 0.0, 1.0);
  return 1 - u * u * (3 - 2 * u);
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

double narrowest_detail(const std::vector<CloudAround>& clouds, std::size_t first, std::size_t end,
                        const Frame& frame) {
  double farthest = 1, narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < end; ++i) {
    const CloudAround& cloud = clouds[i];
    const Vec3& center = cloud.center;
    if (cloud.ray > 0)
      farthest = std::max(farthest, std::hypot(center.a[0], center.a[1], center.a[2]));
    for (const SplatAround& splat : cloud.splats)
      narrowest = std::min(narrowest, narrowest_of(splat, frame));
  }
  return std::min(narrowest, 1 / (farthest * widest_pixel(frame)));
}

std::vector<std::size_t> ends_of_stretches(const std::vector<CloudAround>& clouds,
                                           std::size_t first, std::size_t end, const Frame& frame) {
  // To work fewer out in every pixel takes no longer than to lay one more picture behind the
  // others.
  constexpr std::size_t fewest = 4;
  std::vector<std::size_t> ends;
  std::size_t begin = first;   // of the clouds since the last end
  std::size_t smooth = first;  // of those since the last whose kernel ends in the picture
  for (std::size_t i = first; i < end; ++i) {
    if (!ends_in_picture(clouds[i], frame)) continue;
    if (i - smooth >= fewest) {
      if (smooth > begin) ends.push_back(smooth);
      ends.push_back(i);
      begin = i;
    }
    smooth = i + 1;
  }
  if (smooth > begin && end - smooth >= fewest) ends.push_back(smooth);
  ends.push_back(end);
  return ends;
}

}  // namespace splotchcl
