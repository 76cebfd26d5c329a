#include <algorithm>
#include <cmath>

#include "galaxy/kinds.h"
#include "galaxy/plummer.h"

namespace splotchcl {

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
