#include <cmath>

#include "galaxy/kinds.h"

namespace splotchcl {
namespace {

// Evenly in a ball of radius 1.
Vec3 place_in_ball(Random& random) {
  return random.direction() * std::cbrt(random.uniform());
}

}  // namespace

// A ball of particles has the colour of the pixel that its centre falls in, and is wider than a
// pixel: so balls of different heights and colours overlap along z. If each particle had the colour
// of the pixel below it, every column of particles would have one colour.
GalaxyParticles make_gas(const LightMap& map, const BulgeProfile& bulge,
                         const GalaxySettings& settings) {
  Random random(settings.seed);
  GalaxyParticles gas;
  const Image& picture = map.picture();
  const double cloud_radius = settings.cloud_radius_pixels * map.plane().pixel_size();
  const double share = settings.disk_stars > 0 ? 1 - settings.disk_light : 1;
  const double mass = map.plane().area_of_pixel() / settings.cloud_points;
  const Vec3 axis = disk_axis(settings);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Light light = light_at(picture, x, y);
      if (!(mean(light) > 0)) continue;
      const auto disk = map.plane().in_disk({x + random.uniform(), y + random.uniform()});
      const Light color = share * bulge.rest(light, std::hypot(disk[0], disk[1]));
      const Vec3 center = {{disk[0], disk[1], settings.gas_height_kpc * random.normal()}};
      for (int i = 0; i < settings.cloud_points; ++i) {
        const Vec3 place = center + place_in_ball(random) * cloud_radius;
        add_particle(gas, place, color, mass, axis, std::hypot(place.a[0], place.a[1]));
      }
    }
  }
  return gas;
}

}  // namespace splotchcl
