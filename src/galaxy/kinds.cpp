#include "galaxy/kinds.h"

#include <algorithm>
#include <cmath>

#include "galaxy/even_points.h"
#include "generate/random.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

// The radius that holds a part, in (0, 1], of a Plummer sphere of radius 1, cut at 8.
double plummer_radius(double part) {
  constexpr double farthest = 8;
  const double all = std::pow(1 + 1 / (farthest * farthest), -1.5);
  return 1 / std::sqrt(std::pow(all * part, -2.0 / 3) - 1);
}

// That of a random part.
double plummer_radius(Random& random) {
  return plummer_radius(1 - random.uniform());
}

// Of length 1, at a right angle to a place, else in any direction.
Vec3 axis_across(const Vec3& place, Random& random) {
  const Vec3 axis = boost::qvm::cross(place, random.direction());
  const double length = boost::qvm::mag(axis);
  return length > 0 ? axis / length : Vec3{{0, 0, 1}};
}

// A factor on a star's light: log-normal with mean 1.
double star_brightness(Random& random, double spread = 0.8) {
  return std::exp(spread * random.normal() - spread * spread / 2);
}

// Evenly in a ball of radius 1.
Vec3 place_in_ball(Random& random) {
  return random.direction() * std::cbrt(random.uniform());
}

}  // namespace

namespace {

// A factor on heights.
double flare_at(double radius_kpc, const LightMap& map, const GalaxySettings& settings) {
  return std::exp(settings.flare * (radius_kpc / map.radius() - 0.5));
}

}  // namespace

// Each particle has the colour of a pixel near the one above it, as if balls of particles of one
// colour, wider than a pixel, overlapped: if each had the colour of its own pixel, every column of
// particles would have one colour along z. It is the colour that is moved and not the particle, so
// that particles lie evenly.
GalaxyParticles make_gas(const LightMap& map, const BulgeProfile& bulge,
                         const GalaxySettings& settings) {
  Random random(settings.seed);
  GalaxyParticles gas;
  const Image& picture = map.picture();
  const double share = settings.disk_stars > 0 ? 1 - settings.disk_light : 1;
  const double mass = map.plane().area_of_pixel() / settings.cloud_points;
  const Vec3 axis = disk_axis(settings);
  PointsOfPixels points(settings.cloud_points);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      points.begin(x, y, random);
      for (int i = 0; i < settings.cloud_points; ++i) {
        const DiskPlane::Point pixel = points.place(i);
        const double quantile = normal_quantile(points.layer(i, random));
        const Vec3 aside = place_in_ball(random) * settings.cloud_radius_pixels;
        const DiskPlane::Point disk = map.plane().in_disk(pixel);
        const DiskPlane::Point lit =
            map.plane().in_disk({pixel[0] + aside.a[0], pixel[1] + aside.a[1]});
        const Light color = share * bulge.rest(map.at(lit), std::hypot(lit[0], lit[1]));
        if (!(mean(color) > 0)) continue;
        const double radius = std::hypot(disk[0], disk[1]);
        const double height = flare_at(radius, map, settings) * settings.gas_height_kpc * quantile;
        add_particle(gas, {{disk[0], disk[1], height}}, color, mass, axis, radius);
      }
    }
  }
  return gas;
}

// A particle's mass times its colour is what it absorbs: an optical depth times an area.
GalaxyParticles make_dust(const LightMap& map, const GalaxySettings& settings) {
  Random random(settings.seed + 4);
  GalaxyParticles dust;
  const double area = map.plane().area_of_pixel() / settings.dust_points;
  const Vec3 axis = disk_axis(settings);
  constexpr double least_depth = 0.01;  // less is not seen
  PointsOfPixels points(settings.dust_points);
  for (int y = 0; y < map.picture().height; ++y) {
    for (int x = 0; x < map.picture().width; ++x) {
      const double depth = map.dust().depth(x, y);
      points.begin(x, y, random);
      if (depth < least_depth) continue;
      for (int i = 0; i < settings.dust_points; ++i) {
        const DiskPlane::Point disk = map.plane().in_disk(points.place(i));
        const double radius = std::hypot(disk[0], disk[1]);
        const double height = flare_at(radius, map, settings) * settings.dust_height_kpc *
                              normal_quantile(points.layer(i, random));
        add_particle(dust, {{disk[0], disk[1], height}}, map.dust().opacity(), depth * area, axis,
                     radius);
      }
    }
  }
  return dust;
}

namespace {

constexpr double color_spread = 0.2;

// A star's own light against the mean of its neighbourhood; 1 on average over stars.
Light star_color(const Light& around, Random& random) {
  const double brightness = star_brightness(random);
  const double warmth = std::clamp(color_spread * random.normal(), -0.6, 0.6);
  return {brightness * (1 + warmth) * around[0], brightness * around[1],
          brightness * (1 - warmth) * around[2]};
}

}  // namespace

GalaxyParticles make_disk_stars(const LightMap& map, const BulgeProfile& bulge,
                                const GalaxySettings& settings) {
  Random random(settings.seed + 1);
  GalaxyParticles stars;
  const double width = settings.disk_width * map.radius();
  const double central_density =
      static_cast<double>(settings.disk_stars) / (2 * pi * width * width);
  const Vec3 axis = disk_axis(settings);
  const double jitter = jitter_between(settings.disk_stars);
  for (std::uint64_t i = 0; i < settings.disk_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = width * std::sqrt(-2 * std::log1p(-even.a[0]));
    const double angle = 2 * pi * even.a[1];
    const Vec3 place = {
        {radius * std::cos(angle), radius * std::sin(angle),
         flare_at(radius, map, settings) * settings.disk_height_kpc * normal_quantile(even.a[2])}};
    const Light around = bulge.rest(map.at({place.a[0], place.a[1]}), radius);
    const Light color = star_color(settings.disk_light * around, random);
    // Where stars are few each stands for a larger area. Dark places have none.
    const double density = central_density * std::exp(-radius * radius / (2 * width * width));
    if (mean(color) > 0) add_particle(stars, place, color, 1 / density, axis, radius);
  }
  return stars;
}

GalaxyParticles make_bulge(const BulgeProfile& bulge, const GalaxySettings& settings) {
  Random random(settings.seed + 2);
  GalaxyParticles stars;
  if (!(mean(bulge.peak()) > 0)) return stars;
  const double mass = bulge.area() / static_cast<double>(settings.bulge_stars);
  const double jitter = jitter_between(settings.bulge_stars);
  for (std::uint64_t i = 0; i < settings.bulge_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = settings.bulge_radius_kpc * plummer_radius(1 - even.a[0]);
    const double along = 2 * even.a[1] - 1, across = std::sqrt(1 - along * along);
    const double angle = 2 * pi * even.a[2];
    const Vec3 place = Vec3{{across * std::cos(angle), across * std::sin(angle),
                             settings.bulge_flattening * along}} *
                       radius;
    add_particle(stars, place, star_brightness(random) * bulge.peak(), mass,
                 axis_across(place, random), boost::qvm::mag(place));
  }
  return stars;
}

// Spread in radius like the galaxy's halo; their stars circle the galaxy together.
GalaxyParticles make_clusters(const LightMap& map, const GalaxySettings& settings) {
  Random random(settings.seed + 3);
  GalaxyParticles stars;
  if (settings.clusters == 0) return stars;
  constexpr double halo_fraction = 0.25;  // the Plummer radius of their positions, of the galaxy's
  constexpr double number_spread = 0.8, size_spread = 0.4;
  constexpr Light old_stars = {1.2, 1.0, 0.75};  // their mean is close to 1
  const double light_per_star = settings.cluster_light * map.total_light() /
                                (static_cast<double>(settings.clusters) * settings.cluster_stars);
  const double star_area = map.plane().area_of_pixel() / settings.cluster_stars;
  for (int cluster = 0; cluster < settings.clusters; ++cluster) {
    const double radius = halo_fraction * map.radius() * plummer_radius(random);
    const Vec3 center = random.direction() * radius;
    const Vec3 axis = axis_across(center, random);
    const double size = settings.cluster_radius_kpc * std::exp(size_spread * random.normal());
    const int count = std::max(
        1, static_cast<int>(settings.cluster_stars * std::exp(number_spread * random.normal())));
    for (int i = 0; i < count; ++i) {
      const Vec3 place = center + random.direction() * (size * plummer_radius(random));
      add_particle(stars, place, (star_brightness(random) * light_per_star / star_area) * old_stars,
                   star_area, axis, radius);
    }
  }
  return stars;
}

}  // namespace splotchcl
