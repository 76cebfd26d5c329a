#include <cmath>

#include "galaxy/even_points.h"
#include "galaxy/kinds.h"

namespace splotchcl {
namespace {

// Evenly in a ball of radius 1.
Vec3 place_in_ball(Random& random) {
  return random.direction() * std::cbrt(random.uniform());
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
        const double height = settings.gas_height_kpc * normal_quantile(points.layer(i, random));
        const Vec3 aside = place_in_ball(random) * settings.cloud_radius_pixels;
        const DiskPlane::Point disk = map.plane().in_disk(pixel);
        const DiskPlane::Point lit =
            map.plane().in_disk({pixel[0] + aside.a[0], pixel[1] + aside.a[1]});
        const Light color = share * bulge.rest(map.at(lit), std::hypot(lit[0], lit[1]));
        if (!(mean(color) > 0)) continue;
        add_particle(gas, {{disk[0], disk[1], height}}, color, mass, axis,
                     std::hypot(disk[0], disk[1]));
      }
    }
  }
  return gas;
}

}  // namespace splotchcl
